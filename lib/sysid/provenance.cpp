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

std::vector<ParameterEstimate> at_an_end(const Calibrated& calibrated, const material::ParameterRanges& ranges,
                                         material::FitTarget target) {
  std::vector<material::ParameterRange> all;
  std::ranges::copy(ranges.modulus(target), std::back_inserter(all));
  std::ranges::copy(ranges.toughness(target), std::back_inserter(all));
  std::vector<ParameterEstimate> determined, others;
  for (std::size_t i = 0; i < std::min(all.size(), calibrated.estimates.size()); ++i) {
    const ParameterEstimate& each = calibrated.estimates[i];
    if (each.value != all[i].minimum && each.value != all[i].maximum) continue;
    (each.determined ? determined : others).push_back(each);
  }
  std::ranges::copy(others, std::back_inserter(determined));
  return determined;
}

}  // namespace nacre::sysid
