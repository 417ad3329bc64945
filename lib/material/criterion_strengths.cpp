#include "material/criterion_strengths.hpp"

namespace nacre::material {

double strength_ratio(const FailureCriterion& criterion) {
  switch (criterion.kind) {
    case CriterionKind::element:
      return 1.0;
    case CriterionKind::neighbourhood:
      return kElementFractureEnergy * thesis::kElementSize / (kNeighbourhoodFractureEnergy * criterion.radius_m);
    case CriterionKind::crack_band:
      return kCrackBandStrength / (1.0 + criterion.softening);
  }
  return 1.0;
}

ToughnessParameters with_strengths(ToughnessParameters eta, double factor) {
  for (double* strength : {&eta.w_tb_j_per_m3, &eta.w_vw_j_per_m3, &eta.w_if_j_per_m3}) *strength *= factor;
  return eta;
}

const ParameterRanges& default_ranges() {
  static const ParameterRanges ranges = ranges_for(base_criterion());
  return ranges;
}

ParameterRanges ranges_for(const FailureCriterion& criterion) {
  ParameterRanges ranges = thesis_ranges();
  const double ratio = strength_ratio(criterion);
  for (auto* table : {&ranges.base_toughness, &ranges.microstructure_toughness})
    for (ParameterRange& range : *table)
      if (range.name.starts_with("w_")) range.minimum *= ratio, range.maximum *= ratio;
  return ranges;
}

}  // namespace nacre::material
