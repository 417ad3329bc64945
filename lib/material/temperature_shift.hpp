#pragma once
// The law `temperature_shift`: a warm specimen responds as a cold one does to a slower pull (time-temperature
// superposition), by the shift of Williams, Landel and Ferry (J. Am. Chem. Soc. 77, 3701, 1955):
// log10 a = -k (T - 23) / (1 + (T - 23)/C), k decades of the rate per degree at 23 C, C = C_2 degrees.

#include "material/parameters.hpp"

namespace nacre::material {

/// Temperature at which a specimen responds to the rate at which it is pulled: the standard atmosphere of ISO 291.
inline constexpr double kReferenceTemperatureC = 23.0;

/// Strain rate at 23 C to which a specimen responds as to `strain_rate_per_s` at `temperature_c`. Near the pole and
/// beyond it that of the coldest temperature above it, 23 C - 0.9 C. Exactly the same rate without the extension.
double equivalent_rate(double strain_rate_per_s, const Extensions& extensions, double temperature_c);

}  // namespace nacre::material
