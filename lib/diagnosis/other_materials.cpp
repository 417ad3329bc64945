#include "diagnosis/other_materials.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/coordinates.hpp"

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
  for (int material = 0; material < static_cast<int>(kConstantMaterials.size()); ++material) {
    const std::optional<double> log_e = log_modulus(observations, material);
    const auto [low, high] = searched_bounds(ranges.base_modulus[material], true, rules);
    if (log_e && (*log_e < low || *log_e > high)) found.push_back({material, std::exp(*log_e)});
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
