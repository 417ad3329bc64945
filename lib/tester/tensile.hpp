#pragma once
// The tensile tester: an unnotched homogeneous coupon as a material point under uniaxial stress (Eq. 2.1).

#include <vector>

#include "tester/curve.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// Stress at each of the given nominal strains, integrated in real time at the strain rate of the conditions. Error: a
/// design that is not homogeneous, a strain of -1 or less, a strain at which the law has no state.
Result<Curve> test_tensile(const Simulation& simulation, const std::vector<double>& strain_history);

}  // namespace nacre::tester
