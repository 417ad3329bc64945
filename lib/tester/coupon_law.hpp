#pragma once
// The material of a homogeneous coupon that is pulled.

#include "base/result.hpp"
#include "material/extended_law.hpp"
#include "material/pulled_bar.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// The law of a homogeneous coupon and how it forgets; it shrank freely before.
struct CouponLaw {
  material::ExtendedLaw law;
  material::RelaxationFunction relaxation = {};
  material::PulledBar bar() const { return material::PulledBar(law, relaxation); }
  bool operator==(const CouponLaw&) const = default;
};

/// Of a coupon that is pulled at the rate of its conditions, with so long pauses. Error: an unusable simulation, or a
/// design that is not homogeneous.
Result<CouponLaw> coupon_law(const Simulation& simulation, double pauses_s = 0.0);

}  // namespace nacre::tester
