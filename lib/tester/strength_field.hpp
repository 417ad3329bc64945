#pragma once
// A specimen is a draw: the field of strengths in which specimens of one design differ.

#include <functional>

#include "fem/grid.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// Values that strength_cv may take beside 0. Prior of a fit: log-normal, median 0.10, factor 1.5.
inline constexpr double kSmallestStrengthCv = 0.02, kLargestStrengthCv = 0.4;
bool is_strength_cv(double value);

/// Multiplies W of every region of one unrefined element (half a pixel) by exp(s z - s^2/2), s^2 = ln(1 + cv^2), with
/// z standard normal: mean 1, coefficient of variation cv = simulation.strength_cv. The z are drawn row by row from a
/// stream named by design, orientation and specimen alone, so that every mesh and every model breaks the same
/// specimens. The grid is that of the simulation, refined so often, before its notch is cut. No change at cv = 0.
void draw_strengths(fem::Grid& grid, int refinement, const Simulation& simulation, int specimen);

/// Multiplies the thresholds of all parts of an unrefined element by one factor, drawn row by row from the bottom left.
void multiply_strengths(fem::Grid& grid, int refinement, const std::function<double()>& draw_factor);

}  // namespace nacre::tester
