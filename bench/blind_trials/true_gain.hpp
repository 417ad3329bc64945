#pragma once
// Gain in cross-validation of the named model and of the true one.

#include <filesystem>

#include "trial.hpp"

namespace nacre::blind_trials {

/// Gains of two models on held-out designs of one trial, as shares of the base model's error.
struct TrueGain {
  double named = 0.0, truth = 0.0;                    ///< of log E and log T (diagnosis::Gain::relative_reduction)
  double named_features = 0.0, truth_features = 0.0;  ///< of all features, each in units of its noise
};

/// The gain of the models that a diagnosis of FOLDER/set may choose, folds and choice as in the diagnosis, and that of
/// the true model: the hidden effects at their hidden sizes, its base refitted. For trials that hide known effects;
/// prints the trial when FOLDER/set is not there.
TrueGain true_gain(const BlindTrial& trial, const TrialOptions& options, const std::filesystem::path& folder);

}  // namespace nacre::blind_trials
