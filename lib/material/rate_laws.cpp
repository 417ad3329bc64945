#include "material/rate_laws.hpp"

#include <cmath>

#include "material/extended_law.hpp"
#include "material/extensions.hpp"

namespace nacre::material {
namespace {

Phases by_powers(Phases phases, const Extensions& extensions, double strain_rate_per_s) {
  const double soft = extension_value(extensions, "rate_power_law", 0);
  if (soft == 0.0) return phases;
  const double log_rate = std::log(strain_rate_per_s / kReferenceRatePerS);
  phases.soft.young_pa *= std::exp(soft * log_rate);
  phases.interface.young_pa *= std::exp(soft * extension_value(extensions, "rate_power_law", 1) * log_rate);
  phases.rigid.young_pa *= std::exp(soft * extension_value(extensions, "rate_power_law", 2) * log_rate);
  return phases;
}

Phases by_two_branches(Phases phases, const Extensions& extensions, double strain_rate_per_s) {
  const double first = extension_value(extensions, "rate_prony", 0);
  if (first == 0.0) return phases;
  const double time_s = extension_value(extensions, "rate_prony", 1);
  const LawExtensions one{.overstress = first, .relaxation_time_s = time_s},
      other{.overstress = extension_value(extensions, "rate_prony", 2),
            .relaxation_time_s = time_s * extension_value(extensions, "rate_prony", 3)};
  const double stiffening = rate_stiffening(one, strain_rate_per_s) + rate_stiffening(other, strain_rate_per_s) - 1.0;
  for (Constants* phase : {&phases.soft, &phases.interface, &phases.rigid}) phase->young_pa *= stiffening;
  return phases;
}

}  // namespace

Phases phases_at_rate(Phases phases, const Extensions& extensions, double strain_rate_per_s) {
  return by_two_branches(by_powers(phases, extensions, strain_rate_per_s), extensions, strain_rate_per_s);
}

}  // namespace nacre::material
