#pragma once
// Cross-validation: prediction errors of base and extended model on designs that were held out of the fit.

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Drop of chi2 that chance alone exceeds with the level of a name: a model is preferred to the base when it lowers
/// chi2 by more.
double drop_needed(const Evidence& evidence);

/// held_out_gain() of a model that was decided for, its sizes free: folds must not know a size that was fitted to all
/// the data.
Gain gain_of(const Evidence& evidence, const FittedModel& decided);

/// Mean absolute errors on held-out patterns, base against the model that would have been selected without them: some
/// folds of whole layouts (twins stay together) and of coupons of one material at one rate, selection repeated in each
/// fold among `models`, linear refits around the full fits. The overall figure is that of moduli and toughness of
/// layouts, or of slopes and stresses of coupons where none of `effects` acts on layouts. A model that lowers chi2 by
/// less than `least_drop` is not preferred to the base. 90 % interval by bootstrap over designs. `extended`: the
/// observations with what the models leave free; nothing: the same ones.
Gain held_out_gain(const Observations& observations, const FittedModel& base, const std::vector<FittedModel>& models,
                   const std::vector<std::string>& effects, double least_drop, const GainRules& rules,
                   std::uint64_t seed, const Observations* extended = nullptr);

}  // namespace nacre::diagnosis
