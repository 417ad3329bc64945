#pragma once
// The relaxation tester: an unnotched homogeneous coupon whose strain is stepped and held.

#include "base/result.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// Relaxation modulus (stress over strain, Pa) of a homogeneous coupon at `time_s` > 0 after a small step of strain, by
/// the relaxation functions of its rate laws; the strain rate of the conditions is not used. Error: a design that is
/// not homogeneous, an impossible simulation.
Result<double> relaxation_modulus(const Simulation& simulation, double time_s);

}  // namespace nacre::tester
