#include "material/rate_power_law.hpp"

#include <cmath>

#include "material/extensions.hpp"

namespace nacre::material {

Phases phases_at_rate(Phases phases, const Extensions& extensions, double strain_rate_per_s) {
  const double soft = extension_value(extensions, "rate_power_law", 0);
  if (soft == 0.0) return phases;
  const double log_rate = std::log(strain_rate_per_s / kReferenceRatePerS);
  phases.soft.young_pa *= std::exp(soft * log_rate);
  phases.interface.young_pa *= std::exp(soft * extension_value(extensions, "rate_power_law", 1) * log_rate);
  phases.rigid.young_pa *= std::exp(soft * extension_value(extensions, "rate_power_law", 2) * log_rate);
  return phases;
}

}  // namespace nacre::material
