#pragma once
// Limits of measured values. Tables, sheets and messages have the same limits, so that every specimen that can be read
// can also be sent to a game.

#include <cstddef>

namespace nacre::measurement {

/// A closed range.
struct Limits {
  double least;
  double most;
  bool hold(double value) const { return value >= least && value <= most; }
};

/// Below: most likely GPa or MPa written as Pa, or MJ/m3 as J/m3. One such value in a game makes relative errors of a
/// million and more, and distorts the model. Above: Pa written as MPa, or no material.
inline constexpr Limits kModulusPa{1e4, 1e12};
inline constexpr Limits kToughnessPa{10.0, 1e9};

inline constexpr Limits kStressPa{-1e13, 1e13};
inline constexpr Limits kStrain{-100.0, 100.0};
inline constexpr Limits kStrainRatePerS{1e-9, 1e5};
inline constexpr Limits kThicknessMm{1e-3, 1e3};
/// Beyond these a value is used but doubted: most likely a unit was not converted.
inline constexpr Limits kUsualModulusPa{kModulusPa.least, 1e11};
inline constexpr Limits kUsualPeakPa{1e3, 1e10};
inline constexpr double kMostUsualStrain = 3.0;

inline constexpr std::size_t kLongestName = 200;  ///< of a specimen, in bytes

}  // namespace nacre::measurement
