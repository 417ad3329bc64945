#pragma once
// What W means by each failure criterion: the same fracture energy needs another W, so ranges and built-in values of W
// follow the criterion (docs/studies/toughness.md).

#include "material/failure_criterion.hpp"
#include "material/parameters.hpp"
#include "material/ranges.hpp"

namespace nacre::material {

/// Energy release rate at which a sharp crack grows, over W times a length: the element size h of `element`, the radius
/// R = 2 h of `neighbourhood`. Measured by `FractureEnergy.*` in tests/physics.
inline constexpr double kElementFractureEnergy = 2.10, kNeighbourhoodFractureEnergy = 3.875;
/// A crack band's W times (1 + v0) over that of `element`, for equal T of notched layouts at v0 = 3.
inline constexpr double kCrackBandStrength = 2.0;

/// W by this criterion over W by `element` at equal fracture energy.
double strength_ratio(const FailureCriterion& criterion);

/// eta with every W multiplied.
ToughnessParameters with_strengths(ToughnessParameters eta, double factor);

/// Tables A.1 and A.2 with the ranges of W for this criterion.
ParameterRanges ranges_for(const FailureCriterion& criterion);

}  // namespace nacre::material
