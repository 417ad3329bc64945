#include "material/surroundings_laws.hpp"

#include <cmath>

#include "material/extensions.hpp"

namespace nacre::material {

double stiffness_in_surroundings(const Extensions& extensions, int material, double humidity_pct, double age_days) {
  const double per_pct = extension_value(extensions, "humidity_dependence", material),
               exponent = extension_value(extensions, "ageing", material);
  return std::exp(per_pct * (humidity_pct - kReferenceHumidityPct) + exponent * std::log1p(age_days));
}

}  // namespace nacre::material
