#pragma once
// What temperature does in the laboratory: a material responds to a pull when warm as it does when cold to a slower one
// (time-temperature superposition). Where nothing hidden depends on the rate, nothing depends on temperature.

namespace nacre::laboratory {

/// The constants of a truth hold here: the standard atmosphere of ISO 291.
inline constexpr double kReferenceC = 23.0;
/// The shift has no pole there, and no polymer burns.
inline constexpr double kColdestC = -20.0, kHottestC = 150.0;

/// Strain rate at 23 degrees C over the rate at `temperature_c`, -20 to 150, that shows the same stiffness:
/// log10 = -8.86 (T - 23)/(101.6 + T - 23), the universal constants of Williams, Landel, Ferry (J. Am. Chem. Soc. 77,
/// 3701, 1955).
double rate_shift(double temperature_c);

}  // namespace nacre::laboratory
