#pragma once
// A specimen is a draw: the field of strengths in which specimens of one design differ.

#include <functional>

#include "fem/grid.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// Multiplies W of every region of one unrefined element (half a pixel) by exp(s z - s^2/2), s^2 = ln(1 + cv^2), with
/// z standard normal: mean 1, coefficient of variation cv = parameters.strength_cv. The z are drawn row by row from a
/// stream named by design, orientation and specimen alone, so that every mesh and every model breaks the same
/// specimens. The grid is that of the simulation, refined so often, before its notch is cut. No change at cv = 0.
void draw_strengths(fem::Grid& grid, int refinement, const Simulation& simulation);

/// Whether specimens of one design differ: strength_cv or `strength_scatter` above 0.
bool specimens_differ(const material::ParameterSet& parameters);

/// Multiplies the thresholds of all parts of an unrefined element by one factor, drawn row by row from the bottom left.
void multiply_strengths(fem::Grid& grid, int refinement, const std::function<double()>& draw_factor);

}  // namespace nacre::tester
