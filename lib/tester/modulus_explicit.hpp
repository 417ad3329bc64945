#pragma once

#include "base/result.hpp"
#include "fem/grid.hpp"

namespace nacre::tester {

/// Young's modulus by explicit time integration with the damping of Eq. 2.5 until rest, as in the thesis; Pa. Stays for
/// comparison with the static solver, which is its limit. Error: blow-up with step and element.
Result<double> explicit_modulus(const fem::Grid& grid, double gamma_per_s);

}  // namespace nacre::tester
