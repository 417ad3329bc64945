#pragma once
// How a laboratory's truth is drawn. Every constant has a random stream of its own, so that adding one changes no
// other.

#include <cstdint>

#include "laboratory/effect_kinds.hpp"
#include "laboratory/truth.hpp"

namespace nacre::laboratory {

/// Material constants of this seed (W by the criterion `element`), near those that microstructures show (Table A.2) and
/// different from the bulk's.
material::ModulusParameters draw_modulus_parameters(std::uint64_t seed);
material::ToughnessParameters draw_toughness_parameters(std::uint64_t seed);

/// Variation of W between regions: 0.06 to 0.17, the middle 80 % of its prior.
double draw_strength_cv(std::uint64_t seed);

/// Lognormal about 1, standard deviation 0.08 of the logarithm, each by itself.
CouponRatios draw_coupon_ratios(std::uint64_t seed);

/// None, one or two effects (30, 50, 20 %) with magnitudes that matter.
HiddenEffects draw_effects(std::uint64_t seed);
/// The magnitude that this seed gives to one effect, and to its second number.
double draw_effect_value(std::uint64_t seed, const EffectKind& kind);
double draw_second_value(std::uint64_t seed, const EffectKind& kind);

/// The truth of a laboratory that has no file: everything drawn from the seed.
Truth draw_truth(std::uint64_t seed, tester::Fidelity fidelity);

}  // namespace nacre::laboratory
