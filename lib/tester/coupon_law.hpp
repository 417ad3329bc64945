#pragma once
// The material of a homogeneous coupon that is pulled.

#include "base/result.hpp"
#include "material/extended_law.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// The law of a homogeneous coupon at the rate of its conditions; it shrank freely before. Error: an unusable
/// simulation, or a design that is not homogeneous.
Result<material::ExtendedLaw> coupon_law(const Simulation& simulation);

}  // namespace nacre::tester
