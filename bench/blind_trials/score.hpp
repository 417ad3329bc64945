#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trial.hpp"

namespace nacre::blind_trials {

/// What a diagnosis said of a trial, against the opened answer.
struct Score {
  Trial trial;
  std::string verdict;
  std::vector<std::string> named;                    ///< effects named
  std::vector<std::vector<std::string>> possible;    ///< the reported set
  bool right_name = false, in_set = false;           ///< exactly the hidden effects named; or one of the reported models is exactly them
  double parameter_error = -1.0;                     ///< relative; negative: not named
  bool covered = false;                              ///< the 90 % interval holds the hidden size
  double s = 0.0, rho = 0.0, ceiling = 0.0;          ///< of the first hidden effect on the moduli, as sealed
  double gain = 0.0;                                 ///< relative reduction of held-out error
};

Score score_trial(const Trial& trial, const std::filesystem::path& folder);

/// Rates with 95 % bounds, the confusion matrix and every trial, as Markdown.
std::string report_of(const std::vector<Score>& scores);

}  // namespace nacre::blind_trials
