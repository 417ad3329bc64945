#pragma once
// Whether an extension that a diagnosis named predicts better out of sample: only predictions made before a design is
// measured count (docs/decisions/0015).

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measurement/summary.hpp"
#include "sysid/calibration.hpp"
#include "sysid/prediction.hpp"

namespace nacre::game {

/// Out-of-sample errors of two models in one quantity of one design: natural logarithms of prediction over measurement,
/// both predictions older than the measurement.
struct OutOfSampleError {
  std::string design;
  int round = 0;  ///< of both predictions: errors of one round's model have a common offset
  double adopted = 0.0, extended = 0.0;
};

/// Errors of E and of T, one entry per design that both models had predicted.
struct ExtensionTrialErrors {
  std::vector<OutOfSampleError> modulus, toughness;
  /// Adds the designs of `measured` for which both have a prediction (by canonical design name, as the testing machine
  /// would record it).
  void add(int round, const std::vector<measurement::Replicates>& measured,
           const std::map<std::string, sysid::Prediction>& adopted,
           const std::map<std::string, sysid::Prediction>& extended);
};

/// Out-of-sample errors and Bayes factors of two models in one quantity.
struct ExtensionTrialStanding {
  int designs = 0;
  double adopted = 0.0, extended = 0.0;          ///< mean absolute errors
  double for_extended = 0.0, for_adopted = 0.0;  ///< decadic logarithm of the Bayes factor against the mean prediction
};

/// The Bayes factor of a model is the likelihood of its out-of-sample predictions over that of the mean of both models'
/// predictions: two models that are equally far off straddle the truth, and then their mean does better than either. An
/// error is Student's t with 4 degrees of freedom about an offset of its round, both with the scatter of the model's
/// own errors, at least `least` (measurement scatter and discretisation error); one in twenty is an outlier of any
/// size.
ExtensionTrialStanding standing_of(std::span<const OutOfSampleError> errors, double least);

/// Least scatter of log E and of log T: measurement scatter and discretisation error.
inline constexpr double kLeastModulusError = 0.01, kLeastToughnessError = 0.1;

/// A Bayes factor of 20 for better predictions of E or of T, which does not rest on a single design against all others,
/// and not the same factor for worse predictions of the other. At least three designs. Rate of false adoptions:
/// docs/decisions/0015.
bool gain_is_established(const ExtensionTrialErrors& errors);

}  // namespace nacre::game
