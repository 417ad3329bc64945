#pragma once

#include <cmath>

namespace nacre::measurement {

/// The value to so many significant digits.
inline double rounded(double value, int digits) {
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
  return std::round(value * scale) / scale;
}

}  // namespace nacre::measurement
