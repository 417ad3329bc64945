#pragma once
// Extensions by which the stiffness of the phases goes with the strain rate. A modulus is read where every strain has
// the same rate; a strain that is held after a step shows the same laws as functions of time, and a coupon remembers
// its whole way (relaxation_function.hpp). Layouts and notched specimens do not.
//
//   rate_power_law  E of each phase times (rate/6.17e-4)^n: a broad spectrum of relaxation times over some decades
//                   (Ferry, Viscoelastic Properties of Polymers, 1980)
//   rate_by_phase   E of each phase times 1 + a Maxwell branch of its own overstress, all of one time; overstresses of
//                   blends between two phases are interpolated
//   rate_prony      E of all phases times 1 + two Maxwell branches (rate_stiffening), each with a time of its own
//
// A pull measures the chord between e1 = 0.05 and e2 = 0.25 % of the stress that the relaxation function G builds up,
// rate times the integral of G. A power of the rate belongs to G(t) = E (6.17e-4 t)^-n c(n) with
// c(n) = (1 - n)(e2 - e1)/(e2^(1 - n) - e1^(1 - n)).

#include "material/extended_law.hpp"
#include "material/mixture.hpp"
#include "material/parameters.hpp"

namespace nacre::material {

/// Rate at which the phases have the constants that a parameter set states (thesis 2.2.2), 1/s.
inline constexpr double kReferenceRatePerS = 6.17e-4;

/// A pull at the rate kRelaxationStrain / t is as stiff as a held strain after the time t, where a material relaxes
/// slowly: c(n) is kRelaxationStrain^n for n -> 0. The mean of log strain over the chord.
inline constexpr double kRelaxationStrain = 1.375e-3;

/// What a power of the rate with exponent `n` leaves of the modulus `time_s` after a step of strain, over the modulus
/// at the reference rate: (6.17e-4 t)^-n c(n).
double held_power(double n, double time_s);

/// Phases at a strain rate: exponents n of the soft phase, and of interface and rigid phase by their ratios to it; of
/// two branches overstress and time of the first, overstress of the second and its time over the first. Exactly the
/// same phases without an extension.
Phases phases_at_rate(Phases phases, const Extensions& extensions, double strain_rate_per_s);

/// A homogeneous blend at a strain rate.
Constants blend_at_rate(const Phases& phases, const Extensions& extensions, double rigid_fraction,
                        double strain_rate_per_s);

/// The same as a strain shows it that has been held for `time_s` after a step: relaxation functions of the same laws.
Constants blend_held(const Phases& phases, const Extensions& extensions, double rigid_fraction, double time_s);

/// The branch that rate_by_phase gives a blend; none without it.
LawExtensions branch_of_blend(const Extensions& extensions, double rigid_fraction);

}  // namespace nacre::material
