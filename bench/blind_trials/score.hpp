#pragma once
// Scores of blind trials: rates with Wilson's 95 % interval, confusion matrix, effect sizes.

#include <string>
#include <vector>

#include "trial_diagnosis.hpp"

namespace nacre::blind_trials {

/// The diagnosis of a trial, compared with the opened truth.
struct Score {
  BlindTrial trial;
  TrialDiagnosis diagnosis;
  bool right_name = false,
       in_set = false;            ///< exactly the hidden effects named; or one of the reported models is exactly them
  bool right_family = false;      ///< the named effect is of the hidden effect's family, in whatever form
  double parameter_error = -1.0;  ///< relative, of the first hidden effect; negative: not rightly named
  bool covered = false;           ///< the 90 % interval holds the hidden size
};

Score score_of(const BlindTrial& trial, const TrialDiagnosis& diagnosis);

/// Rates with 95 % bounds, the confusion matrix and every trial, as Markdown.
std::string report_of(const std::vector<Score>& scores);

}  // namespace nacre::blind_trials
