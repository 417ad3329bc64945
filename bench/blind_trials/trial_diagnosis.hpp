#pragma once
// The result of a trial, on one line of the study's table: hidden effects, their visibility, and the diagnosis.

#include <filesystem>
#include <string>
#include <vector>

#include "trial.hpp"

namespace nacre::blind_trials {

/// One effect that was hidden, as sealed before the diagnosis. Rivals are known effects: none of an unmodelled cause.
struct SealedEffect {
  double size = 0.0;          ///< in the parameter's unit
  double snr = 0.0;           ///< signal-to-noise ratio of its signature (column `s`)
  double collinearity = 0.0;  ///< cosine to the nearest rival (column `rho`)
  double ceiling = 0.0;       ///< chance that all rivals lose
};

/// One effect that was named, with its size and 90 % interval.
struct FoundEffect {
  std::string effect;
  double size = 0.0, low90 = 0.0, high90 = 0.0;
};

struct TrialDiagnosis {
  std::string commit;                ///< of the program under test
  std::string verdict;               ///< as in `nacre diagnose --json`
  std::vector<SealedEffect> hidden;  ///< in the order of BlindTrial::hidden
  std::vector<FoundEffect> named;
  std::vector<std::vector<std::string>> possible;  ///< the models that the report leaves open
  double gain = 0.0;                               ///< relative reduction of held-out error; 0: none established
  double p_misfit = 1.0;
};

/// Opens a trial that was diagnosed in `folder` (diagnosis.json, set.truth.toml).
TrialDiagnosis open_trial(const BlindTrial& trial, const std::string& commit, const std::filesystem::path& folder);

/// Columns of the study's table, the trial's name first.
std::vector<std::string> diagnosis_columns();
/// The cells behind the name; several effects are separated by semicolons, several models by slashes.
std::vector<std::string> to_cells(const TrialDiagnosis& diagnosis);
/// Throws InputError where a cell is no number.
TrialDiagnosis diagnosis_from_cells(const std::vector<std::string>& cells);

}  // namespace nacre::blind_trials
