#pragma once

#include "base/result.hpp"
#include "fem/grid.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {

/// Young's modulus, Pa, by explicit time integration with the damping of Eq. 2.5, as in the thesis: from the uniform
/// stretch of 1e-4, which the grips keep, for `steps` of at most 1e-7 s, double precision. Kept for comparison with
/// the static solver, its limit; with little or very much damping it is not at rest after 1e4 steps. Error:
/// blow-up with step and element.
Result<double> explicit_modulus(const fem::Grid& grid, double gamma_per_s, int steps = thesis::kModulusSteps);

/// The same, until E changes by less than `tolerance` (relative) over 1000 steps: the static solver's limit.
/// Error: blow-up, or still moving after 10^6 steps.
Result<double> explicit_modulus_at_rest(const fem::Grid& grid, double gamma_per_s, double tolerance = 1e-5);

}  // namespace nacre::tester
