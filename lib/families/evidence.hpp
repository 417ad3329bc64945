#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nacre::families {

/// One column of numbers over the patterns of a family.
struct FeatureColumn {
  std::string name;
  std::vector<double> values;
};

/// Association of a feature with an outcome over a family. Correlation, not cause: patterns were not drawn to vary this
/// feature alone.
struct Association {
  std::string feature;
  double spearman = 0.0;  ///< rank correlation
  double partial = 0.0;   ///< partial rank correlation: the ranks of the controls are regressed out of both
  double p_family_wise =
      1.0;  ///< chance that the strongest partial correlation of all features is as large when none is real
};

/// Associations of every feature with `outcome`, strongest partial correlation first; ranks of the controls are
/// regressed out of both sides, the p value comes from `permutations` of the outcome's remainder. Columns of equal
/// length, at least five rows more than controls; throws InputError otherwise.
std::vector<Association> associations(const std::vector<FeatureColumn>& features, const FeatureColumn& outcome,
                                      const std::vector<FeatureColumn>& controls, std::uint64_t seed,
                                      int permutations = 2000);

}  // namespace nacre::families
