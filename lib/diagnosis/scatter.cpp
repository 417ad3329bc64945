#include "diagnosis/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace nacre::diagnosis {
namespace {

/// Without replicates a scatter must still be assumed to weigh specimens; every statement is then relative to the fit.
constexpr double kAssumedSd = 0.02;
/// Replicates that agree better than a testing machine reads say nothing about scatter; exactly equal ones would leave
/// a singular covariance. A curve is as linear as load cell and extensometer are (a fifth of class 1 of ISO 7500-1 and
/// ISO 9513). Strains: as a strain.
constexpr double kLeastSd = 1e-4, kLeastCurveSd = 2e-3, kLeastStrainSd = 2e-5;

double least_sd(std::size_t f) {
  const auto feature = static_cast<Feature>(f);
  return feature == Feature::toe_strain ? kLeastStrainSd : feature == Feature::log_modulus ? kLeastSd : kLeastCurveSd;
}

}  // namespace

std::vector<Deviation> deviations_of(const std::vector<std::vector<Measured>>& groups, tester::TestKind test) {
  std::vector<Deviation> deviations;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].size() < 2 || groups[g].front().specimen->test != test) continue;
    FeatureValues mean;
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      const bool all =
          std::all_of(groups[g].begin(), groups[g].end(), [f](const Measured& m) { return m.features[f].has_value(); });
      if (!all) continue;
      double sum = 0.0;
      for (const Measured& each : groups[g]) sum += *each.features[f];
      mean[f] = sum / static_cast<double>(groups[g].size());
    }
    for (const Measured& each : groups[g]) {
      Deviation deviation{&each, static_cast<int>(g), {}};
      for (std::size_t f = 0; f < kFeatureCount; ++f)
        if (mean[f]) deviation.from_mean[f] = *each.features[f] - *mean[f];
      deviations.push_back(deviation);
    }
  }
  return deviations;
}

ReplicateScatter pooled_scatter(const std::vector<std::vector<Measured>>& groups, tester::TestKind test, int batches,
                                const std::string& design) {
  std::vector<Deviation> deviations = deviations_of(groups, test);
  std::map<int, int> group_sizes;
  for (const Deviation& d : deviations) ++group_sizes[d.group];
  const int within = static_cast<int>(deviations.size()) - static_cast<int>(group_sizes.size());
  // Means of batches come off where enough is left to tell scatter by.
  const bool by_batch = batches > 1 && within >= 4 * (batches - 1);
  if (by_batch) {
    std::map<double, std::pair<FeatureValues, std::array<int, kFeatureCount>>> sums;
    for (const Deviation& d : deviations) {
      auto& [sum, count] = sums[d.measured->batch_step];
      for (std::size_t f = 0; f < kFeatureCount; ++f)
        if (d.from_mean[f]) sum[f] = sum[f].value_or(0.0) + *d.from_mean[f], ++count[f];
    }
    for (Deviation& d : deviations) {
      const auto& [sum, count] = sums[d.measured->batch_step];
      for (std::size_t f = 0; f < kFeatureCount; ++f)
        if (d.from_mean[f]) *d.from_mean[f] -= *sum[f] / count[f];
    }
  }
  ReplicateScatter scatter;
  scatter.dof = within - (by_batch ? batches - 1 : 0);
  if (!design.empty()) {
    std::erase_if(deviations, [&](const Deviation& d) { return d.measured->specimen->design.name() != design; });
    std::set<int> own_groups;
    for (const Deviation& d : deviations) own_groups.insert(d.group);
    // The means of batches are everybody's: each bears its share of what they cost.
    scatter.dof = within > 0 ? static_cast<int>(deviations.size() - own_groups.size()) * scatter.dof / within : 0;
  }
  scatter.covariance = Eigen::MatrixXd::Zero(kFeatureCount, kFeatureCount);
  if (scatter.dof <= 0) scatter.dof = 0;
  int features = 0;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    int known = 0;
    for (std::size_t g = 0; g <= f; ++g) {
      double sum = 0.0;
      for (const Deviation& d : deviations)
        if (d.from_mean[f] && d.from_mean[g]) sum += *d.from_mean[f] * *d.from_mean[g], ++known;
      const double value = scatter.dof > 0 ? sum / scatter.dof : 0.0;
      scatter.covariance(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(g)) =
          scatter.covariance(static_cast<Eigen::Index>(g), static_cast<Eigen::Index>(f)) = value;
    }
    features += known > 0;
  }
  const double keep = scatter.dof > 0 ? static_cast<double>(scatter.dof) / (scatter.dof + features) : 0.0;
  for (Eigen::Index f = 0; f < kFeatureCount; ++f) {
    for (Eigen::Index g = 0; g < kFeatureCount; ++g)
      if (f != g) scatter.covariance(f, g) *= keep;
    const double assumed = static_cast<Feature>(f) == Feature::toe_strain ? 0.02 * kAssumedSd : kAssumedSd;
    const double sd = scatter.dof > 0 ? std::sqrt(scatter.covariance(f, f)) : assumed;
    scatter.covariance(f, f) = std::pow(std::max(sd, least_sd(static_cast<std::size_t>(f))), 2);
  }
  return scatter;
}

}  // namespace nacre::diagnosis
