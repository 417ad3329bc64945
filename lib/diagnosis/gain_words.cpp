#include "diagnosis/gain_words.hpp"

#include <cmath>

#include <fmt/format.h>

namespace nacre::diagnosis {

std::string gain_in_words(const Gain& gain) {
  // Errors are of logarithms.
  const double before = 100.0 * std::expm1(gain.held_out_error_before),
               after = 100.0 * std::expm1(gain.held_out_error_after);
  const std::string interval =
      fmt::format("90 % interval {:.0f} to {:.0f} %", 100.0 * gain.interval_low, 100.0 * gain.interval_high);
  const std::string_view designs =
      gain.of_coupons ? "held-out specimens the mean error" : "held-out designs the mean error";
  if (gain.interval_low > 0.0)
    return fmt::format("On {} falls from {:.3g} to {:.3g} %, a reduction by {:.0f} % ({}).", designs, before, after,
                       100.0 * gain.relative_reduction, interval);
  if (gain.interval_high < 0.0)
    return fmt::format("On {} grows from {:.3g} to {:.3g} % with it.", designs, before, after);
  return fmt::format(
      "Its gain is not established: on {} is {:.3g} % without it and {:.3g} % with it (reduction {:.0f} %, {}).",
      designs, before, after, 100.0 * gain.relative_reduction, interval);
}

std::string choice_in_words(const Gain& gain) {
  std::string text;
  if (gain.of_coupons) return text;
  for (const FeatureGain& g : gain.features) {
    const bool counts = g.feature == Feature::log_modulus || g.feature == Feature::log_toughness;
    if (!counts || g.ranking.pairs == 0) continue;
    text += fmt::format(" Of {} pairs of designs that differ measurably in {}, ", g.ranking.pairs, in_words(g.feature));
    text += g.ranking.before == g.ranking.after
                ? fmt::format("both models rank {} as measured.", g.ranking.after)
                : fmt::format("the extended model ranks {} as measured, the base model {}.", g.ranking.after,
                              g.ranking.before);
  }
  return text;
}

}  // namespace nacre::diagnosis
