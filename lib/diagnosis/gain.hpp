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

/// Refits of models that are far from linear in their parameters.
struct ExactRefits {
  const FeatureModel& model;
  const FitRules& rules;
  /// A fit again, from where it is, as if the rows `held` had not been measured.
  FittedModel without(const std::vector<bool>& held, Observations observations, const FittedModel& fit) const;
};

/// Extended models among which each fold selects.
struct ExtendedModels {
  std::vector<FittedModel> models;
  double least_drop = 0.0;                     ///< of chi2, for one to be preferred to the base
  const Observations* observations = nullptr;  ///< with what the models leave free; nothing: those of the base
  const ExactRefits* refits = nullptr;         ///< nothing: linear ones around the full fits
};

/// Mean absolute errors on held-out patterns, base against the model that would have been selected without them: some
/// folds of whole layouts (twins stay together) and of coupons of one material at one rate, selection repeated in each
/// fold. The overall figure is that of moduli and toughness of layouts, or of slopes and stresses of coupons where none
/// of `effects` acts on layouts. 90 % interval by bootstrap over designs.
Gain held_out_gain(const Observations& observations, const FittedModel& base, const ExtendedModels& extending,
                   const std::vector<std::string>& effects, const GainRules& rules, std::uint64_t seed);

}  // namespace nacre::diagnosis
