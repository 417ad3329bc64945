#pragma once
// The laws `humidity_dependence` and `ageing` of a homogeneous material's stiffness: log E goes with h (H - 50 %), H
// relative humidity, and with a log(1 + t), t days of age (physical ageing, as compliances in L. C. E. Struik, Physical
// Aging in Amorphous Polymers, 1978). Each material has an h and an a of its own.

#include "material/parameters.hpp"

namespace nacre::material {

/// Relative humidity of the standard atmosphere of ISO 291, of a specimen for which none is noted.
inline constexpr double kReferenceHumidityPct = 50.0;

/// E over that at 50 % and 0 days, of the material with this number. Exactly 1 without the extensions.
double stiffness_in_surroundings(const Extensions& extensions, int material, double humidity_pct, double age_days);

}  // namespace nacre::material
