#include "diagnosis/other_materials.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/coordinates.hpp"
#include "material/extended_law.hpp"

namespace nacre::diagnosis {
namespace {

/// Mean of log E over the groups of a material's homogeneous specimens; nothing where none tells it.
std::optional<double> log_modulus(const Observations& observations, int material) {
  double sum = 0.0;
  int groups = 0;
  for (const Observation& group : observations.groups) {
    if (group.material() != kConstantMaterials[material] || group.test == tester::TestKind::toughness) continue;
    const Feature feature = group.test == tester::TestKind::modulus ? Feature::log_modulus : Feature::log_tangent_10;
    if (const auto& log_e = value_of(group.features, feature)) sum += *log_e, ++groups;
  }
  if (groups == 0) return std::nullopt;
  return sum / groups;
}

/// E of soft, rigid and interface (kConstantMaterials) by the mixture law through homogeneous specimens of all blends:
/// ridge regression of log E about the middles of the ranges.
std::array<double, 3> by_blends(const Observations& observations, const material::ParameterRanges& ranges) {
  constexpr double kRangeLogSd = 3.0, kBlendLogSd = 0.1;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() / (kRangeLogSd * kRangeLogSd);
  Eigen::Vector3d middle, right;
  for (int m = 0; m < 3; ++m)
    middle[m] = 0.5 * std::log(ranges.base_modulus[m].minimum * ranges.base_modulus[m].maximum);
  right = normal * middle;
  for (const Observation& group : observations.groups) {
    const auto& log_e = value_of(group.features, Feature::log_modulus);
    if (!log_e || group.design.mixture() == nullptr) continue;
    const double rigid = group.design.mixture()->rigid_fraction;
    const Eigen::Vector3d shares(material::soft_share(rigid), material::rigid_share(rigid),
                                 1.0 - std::abs(2.0 * rigid - 1.0));
    normal += shares * shares.transpose() / (kBlendLogSd * kBlendLogSd);
    right += shares * *log_e / (kBlendLogSd * kBlendLogSd);
  }
  const Eigen::Vector3d log_e = normal.ldlt().solve(right);
  return {std::exp(log_e[0]), std::exp(log_e[1]), std::exp(log_e[2])};
}

/// The range made wide enough to hold a value with the range's own width about it.
void stretch_over(material::ParameterRange& range, double value) {
  const double half = std::sqrt(range.maximum / range.minimum);
  range.minimum = std::min(range.minimum, value / half);
  range.maximum = std::max(range.maximum, value * half);
}

}  // namespace

bool is_told_by_own_specimens(const Observations& observations, int material) {
  return log_modulus(observations, material).has_value();
}

std::vector<OtherMaterial> other_materials(const Observations& observations, const material::ParameterRanges& ranges,
                                           ConstantRules rules) {
  rules.widening = rules.other_material;
  std::vector<OtherMaterial> found;
  const auto blends = by_blends(observations, ranges);
  for (int material = 0; material < static_cast<int>(kConstantMaterials.size()); ++material) {
    const std::optional<double> log_e = log_modulus(observations, material);
    const auto [low, high] = searched_bounds(ranges.base_modulus[material], true, rules);
    const double value = log_e ? *log_e : std::log(blends[material]);
    if (value < low || value > high) found.push_back({material, std::exp(value), log_e.has_value()});
  }
  return found;
}

material::ParameterRanges ranges_over(material::ParameterRanges ranges, const std::vector<OtherMaterial>& materials) {
  for (const OtherMaterial& other : materials) {
    stretch_over(ranges.base_modulus[other.material], other.modulus_pa);
    stretch_over(ranges.microstructure_modulus[other.material], other.modulus_pa);
  }
  return ranges;
}

}  // namespace nacre::diagnosis
