#include "laboratory/temperature.hpp"

#include <cmath>

namespace nacre::laboratory {

double rate_shift(double temperature_c) {
  const double above = temperature_c - kReferenceC;
  return std::pow(10.0, -8.86 * above / (101.6 + above));
}

}  // namespace nacre::laboratory
