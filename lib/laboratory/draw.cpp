#include "laboratory/draw.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "material/criterion_strengths.hpp"

namespace nacre::laboratory {
namespace {

double log_uniform(RandomStream& stream, double low, double high) {
  return std::exp(stream.uniform(std::log(low), std::log(high)));
}

/// One constant from a stream of its own.
double drawn(std::uint64_t seed, std::string_view name, double low, double high) {
  RandomStream stream(seed, std::string("truth/") + std::string(name));
  return log_uniform(stream, low, high);
}

}  // namespace

material::ModulusParameters draw_modulus_parameters(std::uint64_t seed) {
  // Around the bulk values of Table 3.4; printed microstructures came out stiffer than those say (Table A.3).
  return {.e_tb_pa = drawn(seed, "theta/e_tb_pa", 0.9 * 1.0094e6, 1.1 * 1.0094e6),
          .e_vw_pa = drawn(seed, "theta/e_vw_pa", 0.95 * 2.6613e9, 1.15 * 2.6613e9),
          .e_if_pa = drawn(seed, "theta/e_if_pa", 0.95 * 0.5642e9, 1.15 * 0.5642e9),
          .nu_tb = drawn(seed, "theta/nu_tb", 0.42, 0.48),
          .nu_vw = drawn(seed, "theta/nu_vw", 0.25, 0.35),
          .nu_if = drawn(seed, "theta/nu_if", 0.32, 0.38),
          .gamma_per_s = drawn(seed, "theta/gamma_per_s", 1e5, 4e5)};
}

material::ToughnessParameters draw_toughness_parameters(std::uint64_t seed) {
  // Inside Table A.2, around values for which notched microstructures absorb what Table A.4 reports.
  return {.e_tb_pa = drawn(seed, "eta/e_tb_pa", 15e6, 60e6),
          .e_vw_pa = drawn(seed, "eta/e_vw_pa", 600e6, 980e6),
          .e_if_pa = drawn(seed, "eta/e_if_pa", 150e6, 450e6),
          .nu_tb = drawn(seed, "eta/nu_tb", 0.42, 0.48),
          .nu_vw = drawn(seed, "eta/nu_vw", 0.25, 0.35),
          .nu_if = drawn(seed, "eta/nu_if", 0.32, 0.38),
          .w_tb_j_per_m3 = drawn(seed, "eta/w_tb_j_per_m3", 0.35e6, 0.95e6),
          .w_vw_j_per_m3 = drawn(seed, "eta/w_vw_j_per_m3", 2e6, 7e6),
          .w_if_j_per_m3 = drawn(seed, "eta/w_if_j_per_m3", 3e6, 10e6),
          .gamma_per_s = drawn(seed, "eta/gamma_per_s", 2e5, 1e6)};
}

double draw_strength_cv(std::uint64_t seed) { return drawn(seed, "strength_cv", 0.06, 0.17); }

CouponRatios draw_coupon_ratios(std::uint64_t seed) {
  constexpr double kLogSd = 0.08;
  const auto ratio = [seed](std::string_view material) {
    RandomStream stream(seed, "truth/coupons/" + std::string(material));
    return std::exp(kLogSd * stream.normal());
  };
  return {.soft = ratio("soft"), .rigid = ratio("rigid"), .interface = ratio("interface")};
}

double draw_effect_value(std::uint64_t seed, const EffectKind& kind) {
  RandomStream stream(seed, std::string("truth/effect/") + std::string(kind.name));
  const double magnitude = log_uniform(stream, kind.drawn_minimum, kind.drawn_maximum);
  return kind.either_sign && stream.index(2) == 1 ? -magnitude : magnitude;
}

double draw_second_value(std::uint64_t seed, const EffectKind& kind) {
  return drawn(seed, "effect/" + std::string(kind.name) + "/second", kind.second.drawn_minimum,
               kind.second.drawn_maximum);
}

HiddenEffects draw_effects(std::uint64_t seed) {
  RandomStream stream(seed, "truth/effects");
  std::vector<const EffectKind*> kinds;
  for (const EffectKind& kind : effect_kinds()) {
    if (kind.drawn_unasked) kinds.push_back(&kind);
  }
  const double chance = stream.uniform();
  const int count = chance < 0.3 ? 0 : chance < 0.8 ? 1 : 2;
  HiddenEffects effects;
  for (int i = 0; i < count; ++i) {
    const int pick = stream.index(static_cast<int>(kinds.size()));
    const EffectKind& kind = *kinds[pick];
    effects.*kind.value = draw_effect_value(seed, kind);
    kinds.erase(kinds.begin() + pick);
  }
  return effects;
}

Truth draw_truth(std::uint64_t seed, tester::Fidelity fidelity) {
  return {.seed = seed,
          .fidelity = fidelity,
          .noise = {},
          .modulus = draw_modulus_parameters(seed),
          .coupons = {},
          .toughness = material::with_strengths(draw_toughness_parameters(seed),
                                                material::strength_ratio(material::base_criterion())),
          .criterion = material::base_criterion(),
          .strength_cv = draw_strength_cv(seed),
          .effects = draw_effects(seed)};
}

}  // namespace nacre::laboratory
