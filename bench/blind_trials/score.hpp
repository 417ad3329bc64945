#pragma once

#include <string>
#include <vector>

#include "answer.hpp"

namespace nacre::blind_trials {

/// What a diagnosis said of a trial, against the opened answer.
struct Score {
  BlindTrial trial;
  TrialDiagnosis answer;
  bool right_name = false,
       in_set = false;            ///< exactly the hidden effects named; or one of the reported models is exactly them
  bool right_family = false;      ///< what is named is of the hidden effect's family, in whatever form
  double parameter_error = -1.0;  ///< relative, of the first hidden effect; negative: not rightly named
  bool covered = false;           ///< the 90 % interval holds the hidden size
};

Score score_of(const BlindTrial& trial, const TrialDiagnosis& answer);

/// Rates with 95 % bounds, the confusion matrix and every trial, as Markdown.
std::string report_of(const std::vector<Score>& scores);

}  // namespace nacre::blind_trials
