#pragma once
// The extension `rate_power_law`: the stiffness of each phase grows as a power of the strain rate, as a broad spectrum
// of relaxation times shows it over some decades (Ferry, Viscoelastic Properties of Polymers, 1980). Of elastic tests
// alone: every strain of one pull has the same rate.

#include "material/mixture.hpp"
#include "material/parameters.hpp"

namespace nacre::material {

/// Rate at which the phases have the constants that a parameter set states (thesis 2.2.2), 1/s.
inline constexpr double kReferenceRatePerS = 6.17e-4;

/// Phases at a strain rate: E times (rate / kReferenceRatePerS)^n, with n of the soft phase, and of interface and rigid
/// phase by their ratios to it. Exactly the same phases without the extension.
Phases phases_at_rate(Phases phases, const Extensions& extensions, double strain_rate_per_s);

}  // namespace nacre::material
