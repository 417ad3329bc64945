#pragma once
// The modulus tester (thesis 2.3.1, Figure 2-5B): E = stress / strain at a strain of 1e-4.

#include "tester/simulation.hpp"

namespace nacre::tester {

struct ModulusResult {
  double modulus_pa = 0.0;
};

/// Young's modulus. Layouts: static equilibrium at strain 1e-4, double precision. Homogeneous designs: material point.
/// Error: what made the solution impossible.
Result<ModulusResult> test_modulus(const Simulation& simulation, const Discretisation& discretisation = {});

/// The part of E that depends on the rate where all materials relax alike: E of a layout is that of the relaxed
/// constants times this.
double rate_factor(const Simulation& simulation);

}  // namespace nacre::tester
