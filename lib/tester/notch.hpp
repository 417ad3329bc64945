#pragma once
// The pre-crack of the toughness specimen (thesis 2.2.2, 2.3.1): a notch and a triangular cut, both on one axis at mid
// height.

#include "fem/grid.hpp"

namespace nacre::tester {

/// Empties the notch (one unrefined element high, 20 % of the width long, from the left edge at unrefined row rows/2)
/// and the triangular cut on its axis (15 % of the width deep, opening angle 60 degrees). At full size these are the 40
/// and 30 elements of the thesis. A refined grid loses the same area: an element goes with the unrefined one it lies
/// in.
void cut_notch(fem::Grid& grid, int refinement);

/// Drills out the root of the notch (extension `blunt_notch`): a circle of `root_radius` (share of the width) whose
/// front stays where the sharp notch ends. An element that the circle cuts keeps stiffness, strength and yield stress
/// in proportion to the area left of it. Nothing changes until the circle is larger than the notch is high.
void round_notch_root(fem::Grid& grid, int refinement, double root_radius);

}  // namespace nacre::tester
