#pragma once
// The failure criterion of a parameter set, as the fracture kernel knows it.

#include "fem/grid.hpp"
#include "material/failure_criterion.hpp"

namespace nacre::tester {

/// Sets the criterion of a grid of refined elements whose thresholds are those of `element`. The effect
/// `progressive_damage` adds to the v0 of a crack band; an element that its neighbourhood fails softens by it. Tails
/// are 1 + v(h) = (1 + v) h0 / h, where h0 is the size of unrefined elements. No change for `element`.
void set_criterion(fem::Grid& grid, int refinement, const material::FailureCriterion& criterion);

}  // namespace nacre::tester
