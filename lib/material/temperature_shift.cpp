#include "material/temperature_shift.hpp"

#include <algorithm>
#include <cmath>

#include "material/extensions.hpp"

namespace nacre::material {

double equivalent_rate(double strain_rate_per_s, const Extensions& extensions, double temperature_c) {
  constexpr double kClosest = 0.1;  // of C to the pole
  const double decades_per_degree = extension_value(extensions, "temperature_shift", 0);
  if (decades_per_degree == 0.0) return strain_rate_per_s;
  const double pole = extension_value(extensions, "temperature_shift", 1);
  const double above = std::max(temperature_c - kReferenceTemperatureC, (kClosest - 1.0) * pole);
  return strain_rate_per_s * std::pow(10.0, -decades_per_degree * above / (1.0 + above / pole));
}

}  // namespace nacre::material
