#pragma once
// Whether an extension that a diagnosis named predicts designs better that nobody had measured: both models say what
// they expect before the laboratory is asked, and only that counts.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sysid/calibration.hpp"

namespace nacre::game {

/// How far two models were off on one quantity of one design: absolute differences of natural logarithms, predictions
/// older than the measurement.
struct ForetoldError {
  std::string design;
  double adopted = 0.0, extended = 0.0;
};

/// Errors of E and of T, one entry per design that both models had foretold.
struct TrialErrors {
  std::vector<ForetoldError> modulus, toughness;
  /// Adds the designs of `measured` for which both have a prediction (by canonical design name, as the testing machine
  /// would show it).
  void add(const std::vector<measurement::Replicates>& measured,
           const std::map<std::string, sysid::Prediction>& adopted,
           const std::map<std::string, sysid::Prediction>& extended);
};

/// What the extended model gained on one quantity.
struct TrialGain {
  int designs = 0;
  double adopted = 0.0, extended = 0.0;  ///< mean errors
  double p_gain = 1.0;                   ///< one-sided chance of such a gain when there is none
  double p_loss = 1.0;                   ///< of such a loss
};

/// Student's t over the designs' log((adopted + least)/(extended + least)): how many times smaller the error is, design
/// by design, since errors of designs differ by far more than models do. `least` is an error that scatter and numerics
/// leave anyway. Gain and loss also ask for the mean error to fall or rise.
TrialGain gain_of(std::span<const ForetoldError> errors, double least);

/// What scatter and numerics leave of log E and of log T.
inline constexpr double kLeastModulusError = 0.01, kLeastToughnessError = 0.1;

/// 5 % over the whole game: E is predicted better at 5 % over the number of rounds, as the diagnosis of a game compares
/// moduli, and T is not shown to be predicted worse at the same level. At least three designs.
bool gain_is_established(const TrialErrors& errors, int rounds);

/// Chance that Student's t with `freedom` (at least 1) degrees of freedom exceeds t: the finite series for whole
/// numbers.
double student_exceedance(double t, int freedom);

}  // namespace nacre::game
