#pragma once
// What a finished trial comes to, on one line of the study's table: what was hidden and how well it could be seen, what
// the diagnosis said.

#include <filesystem>
#include <string>
#include <vector>

#include "trial.hpp"

namespace nacre::blind_trials {

/// One effect that was hidden. Rivals are those of the library: none where it does not hold the effect.
struct Hidden {
  double size = 0.0;  ///< in the parameter's unit
  double s = 0.0, rho = 0.0,
         ceiling = 0.0;  ///< as sealed: signal-to-noise, cosine to the nearest rival, chance that all rivals lose
};

/// One effect that was named, with its parameter and 90 % interval.
struct Named {
  std::string effect;
  double size = 0.0, low90 = 0.0, high90 = 0.0;
};

struct TrialDiagnosis {
  std::string commit;          ///< of the program that was asked
  std::string verdict;         ///< as in `nacre diagnose --json`
  std::vector<Hidden> hidden;  ///< in the order of Trial::hidden
  std::vector<Named> named;
  std::vector<std::vector<std::string>> possible;  ///< the models that the report leaves open
  double gain = 0.0;                               ///< relative reduction of held-out error; 0: none established
  double p_misfit = 1.0;
};

/// Opens the answer of a trial that was diagnosed in `folder` (diagnosis.json, set.truth.toml).
TrialDiagnosis open_answer(const BlindTrial& trial, const std::string& commit, const std::filesystem::path& folder);

/// Columns of the study's table, the trial's name first.
std::vector<std::string> answer_columns();
/// The cells behind the name; several effects are separated by semicolons, several models by slashes.
std::vector<std::string> to_cells(const TrialDiagnosis& answer);
/// Throws InputError where a cell is no number.
TrialDiagnosis answer_from_cells(const std::vector<std::string>& cells);

}  // namespace nacre::blind_trials
