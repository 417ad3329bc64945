#include "material/rate_laws.hpp"

#include <cmath>

#include "material/extensions.hpp"

namespace nacre::material {
namespace {

/// c(n) of the header.
double relaxation_over_chord(double exponent) {
  const double rest = 1.0 - exponent, decades = std::log(kLastChordStrain / kFirstChordStrain);
  const double grown = rest == 0.0 ? decades : std::expm1(rest * decades) / rest;
  return (kLastChordStrain - kFirstChordStrain) / (std::pow(kFirstChordStrain, rest) * grown);
}

/// Multiplies E of each phase by `factor` of its exponent.
template <class Factor>
Phases by_powers(Phases phases, const Extensions& extensions, Factor factor) {
  const double soft = extension_value(extensions, "rate_power_law", 0);
  if (soft == 0.0) return phases;
  phases.soft.young_pa *= factor(soft);
  phases.interface.young_pa *= factor(soft * extension_value(extensions, "rate_power_law", 1));
  phases.rigid.young_pa *= factor(soft * extension_value(extensions, "rate_power_law", 2));
  return phases;
}

/// Multiplies E of all phases by 1 + what each of two branches adds, `stiffening` of one branch.
template <class Stiffening>
Phases by_two_branches(Phases phases, const Extensions& extensions, Stiffening stiffening) {
  const double first = extension_value(extensions, "rate_prony", 0);
  if (first == 0.0) return phases;
  const double time_s = extension_value(extensions, "rate_prony", 1);
  const LawExtensions one{.overstress = first, .relaxation_time_s = time_s},
      other{.overstress = extension_value(extensions, "rate_prony", 2),
            .relaxation_time_s = time_s * extension_value(extensions, "rate_prony", 3)};
  const double both = stiffening(one) + stiffening(other) - 1.0;
  for (Constants* phase : {&phases.soft, &phases.interface, &phases.rigid}) phase->young_pa *= both;
  return phases;
}

/// The laws under which a blend is the mixture of its phases; of rate_by_phase it is not.
Phases by_mixed_laws(const Phases& phases, const Extensions& extensions, double strain_rate_per_s) {
  const double log_rate = std::log(strain_rate_per_s / kReferenceRatePerS);
  return by_two_branches(by_powers(phases, extensions, [&](double n) { return std::exp(n * log_rate); }), extensions,
                         [&](const LawExtensions& branch) { return rate_stiffening(branch, strain_rate_per_s); });
}

}  // namespace

double held_power(double n, double time_s) {
  return std::exp(-n * std::log(kReferenceRatePerS * time_s)) * relaxation_over_chord(n);
}

LawExtensions branch_of_blend(const Extensions& extensions, double rigid_fraction) {
  const double soft = extension_value(extensions, "rate_by_phase", 0),
               time_s = extension_value(extensions, "rate_by_phase", 1);
  if (!(soft > 0.0 && time_s > 0.0)) return {};
  const double of_soft = soft_share(rigid_fraction), of_rigid = rigid_share(rigid_fraction),
               shares = of_soft + (1.0 - of_soft - of_rigid) * extension_value(extensions, "rate_by_phase", 2) +
                        of_rigid * extension_value(extensions, "rate_by_phase", 3);
  return {.overstress = soft * shares, .relaxation_time_s = time_s};
}

Phases phases_at_rate(Phases phases, const Extensions& extensions, double strain_rate_per_s) {
  phases = by_mixed_laws(phases, extensions, strain_rate_per_s);
  phases.soft.young_pa *= rate_stiffening(branch_of_blend(extensions, 0.0), strain_rate_per_s);
  phases.interface.young_pa *= rate_stiffening(branch_of_blend(extensions, 0.5), strain_rate_per_s);
  phases.rigid.young_pa *= rate_stiffening(branch_of_blend(extensions, 1.0), strain_rate_per_s);
  return phases;
}

Constants blend_at_rate(const Phases& phases, const Extensions& extensions, double rigid_fraction,
                        double strain_rate_per_s) {
  Constants blend = mixture(by_mixed_laws(phases, extensions, strain_rate_per_s), rigid_fraction);
  blend.young_pa *= rate_stiffening(branch_of_blend(extensions, rigid_fraction), strain_rate_per_s);
  return blend;
}

Constants blend_held(const Phases& phases, const Extensions& extensions, double rigid_fraction, double time_s) {
  const auto relaxed = [&](double n) { return held_power(n, time_s); };
  const Phases held = by_two_branches(by_powers(phases, extensions, relaxed), extensions,
                                      [&](const LawExtensions& branch) { return held_stiffening(branch, time_s); });
  Constants blend = mixture(held, rigid_fraction);
  blend.young_pa *= held_stiffening(branch_of_blend(extensions, rigid_fraction), time_s);
  return blend;
}

}  // namespace nacre::material
