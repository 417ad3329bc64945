#include "sysid/provenance.hpp"

#include <algorithm>
#include <iterator>

#include "thesis/constants.hpp"

namespace nacre::sysid {

bool is_unbroken(const Prediction& prediction, const pattern::Design& design) {
  constexpr double kNearlyThere = 0.99;  // the record samples the strain
  return prediction.toughness_pa && !prediction.curve.empty() && design.rigid_fraction() > 0.0 &&
         prediction.curve.strain.back() >= kNearlyThere * thesis::kStrainLimit;
}

Provenance provenance_of(const Calibrated& calibrated, std::string_view search) {
  return {.search = std::string(search),
          .modulus_objective = calibrated.modulus_objective_after,
          .toughness_objective = calibrated.toughness_objective_after,
          .modulus_fit = calibrated.modulus_fit,
          .toughness_fit = calibrated.toughness_fit,
          .estimates = calibrated.estimates};
}

namespace {

constexpr double kAtEnd = 1e-6;  // of the range, in the coordinate of the fit: values went through logarithms

/// Whether there were measurements that a parameter was fitted to. The elastic moduli follow moduli, whatever a test of
/// fracture has of its own.
bool was_fitted(const Calibrated& calibrated, const ParameterEstimate& estimate) {
  const bool elastic = estimate.name.starts_with("modulus.");
  return (elastic ? calibrated.after.modulus_count : calibrated.after.toughness_count) > 0;
}

}  // namespace

std::vector<ParameterEstimate> at_an_end(const Calibrated& calibrated, const material::ParameterRanges& ranges,
                                         material::FitTarget target) {
  std::vector<material::ParameterRange> all;
  std::ranges::copy(ranges.modulus(target), std::back_inserter(all));
  std::ranges::copy(ranges.toughness(target), std::back_inserter(all));
  std::vector<ParameterEstimate> determined, others;
  for (std::size_t i = 0; i < std::min(all.size(), calibrated.estimates.size()); ++i) {
    const ParameterEstimate& each = calibrated.estimates[i];
    const double unit = material::to_unit(all[i], each.value);
    if (!was_fitted(calibrated, each) || std::min(unit, 1.0 - unit) > kAtEnd) continue;
    (each.determined ? determined : others).push_back(each);
  }
  std::ranges::copy(others, std::back_inserter(determined));
  return determined;
}

}  // namespace nacre::sysid
