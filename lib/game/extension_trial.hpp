#pragma once
// Whether an extension that a diagnosis named predicts designs better that nobody had measured: both models say what
// they expect before the laboratory is asked, and only that counts (docs/decisions/0015).

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sysid/prediction.hpp"

namespace nacre::game {

/// How far two models were off on one quantity of one design: natural logarithms of prediction over measurement, both
/// predictions older than the measurement.
struct OutOfSampleError {
  std::string design;
  int round = 0;  ///< that both predictions are from: errors of one round's model have an offset in common
  double adopted = 0.0, extended = 0.0;
};

/// Errors of E and of T, one entry per design that both models had foretold.
struct TrialErrors {
  std::vector<OutOfSampleError> modulus, toughness;
  /// Adds the designs of `measured` for which both have a prediction (by canonical design name, as the testing machine
  /// would show it).
  void add(int round, const std::vector<measurement::Replicates>& measured,
           const std::map<std::string, sysid::Prediction>& adopted,
           const std::map<std::string, sysid::Prediction>& extended);
};

/// How two models foretold one quantity.
struct TrialStanding {
  int designs = 0;
  double adopted = 0.0, extended = 0.0;          ///< mean absolute errors
  double for_extended = 0.0, for_adopted = 0.0;  ///< evidence: decadic logarithm of the odds against the mean forecast
};

/// Evidence for a model is the likelihood of what it foretold over that of the mean of both models' forecasts: two
/// models that are equally far off straddle the truth, and then their mean does better than either. An error is
/// Student's t with 4 degrees of freedom about an offset of its round, both with the scatter that the model's own
/// errors show, at least `least`: what scatter and numerics leave anyway; one in twenty may be anything.
TrialStanding standing_of(std::span<const OutOfSampleError> errors, double least);

/// What scatter and numerics leave of log E and of log T.
inline constexpr double kLeastModulusError = 0.01, kLeastToughnessError = 0.1;

/// Odds of 20 to 1 that E is foretold better, which no single design brings about while all others speak against it,
/// and not the same odds that T is foretold worse. At least three designs. How many games adopt an extension that is no
/// better: docs/decisions/0015.
bool gain_is_established(const TrialErrors& errors);

}  // namespace nacre::game
