#pragma once
// Extensions by which the stiffness of the phases goes with the strain rate, of elastic tests alone: every strain of
// one pull has the same rate.
//
//   rate_power_law  E of each phase times (rate/6.17e-4)^n: a broad spectrum of relaxation times over some decades
//                   (Ferry, Viscoelastic Properties of Polymers, 1980)
//   rate_prony      E of all phases times 1 + two Maxwell branches (rate_stiffening), each with a time of its own

#include "material/mixture.hpp"
#include "material/parameters.hpp"

namespace nacre::material {

/// Rate at which the phases have the constants that a parameter set states (thesis 2.2.2), 1/s.
inline constexpr double kReferenceRatePerS = 6.17e-4;

/// Phases at a strain rate: exponents n of the soft phase, and of interface and rigid phase by their ratios to it; of
/// two branches overstress and time of the first, overstress of the second and its time over the first. Exactly the
/// same phases without an extension.
Phases phases_at_rate(Phases phases, const Extensions& extensions, double strain_rate_per_s);

}  // namespace nacre::material
