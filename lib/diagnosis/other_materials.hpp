#pragma once
// Materials other than the inks whose ranges are given: what their own specimens measured counts instead.

#include <vector>

#include "diagnosis/observations.hpp"
#include "material/ranges.hpp"

namespace nacre::diagnosis {

/// Whether homogeneous specimens of a base material tell its E.
bool is_told_by_own_specimens(const Observations& observations, int material);

/// Base materials whose E by their own specimens, or by blends where they have none, lies outside their range in Table
/// A.1 (or that of `ranges`), widened two-fold: within the bounds of the search (CoordinateMap), but near enough for
/// these to matter.
std::vector<OtherMaterial> other_materials(const Observations& observations, const material::ParameterRanges& ranges,
                                           ConstantRules rules);

/// `ranges` with those of E of these materials stretched over what was measured: the inks stay possible, where the
/// machine is wrong.
material::ParameterRanges ranges_over(material::ParameterRanges ranges, const std::vector<OtherMaterial>& materials);

}  // namespace nacre::diagnosis
