#pragma once
// Baselines of a prediction error: E and log T linear in the rigid fraction, and the error floor that discretisation
// and scatter set.

#include "case.hpp"

namespace nacre::calibration_study {

/// Mean relative errors on the held-out designs.
struct Baselines {
  double modulus_line = 0.0;        ///< E linear in rigid fraction, least squares on the fitted designs
  double toughness_constant = 0.0;  ///< the fitted designs' median T
  double toughness_line = 0.0;      ///< log T linear in rigid fraction
  double line_spearman = 0.0;
};
Baselines baselines_of(const StudyCase& study_case);

/// Errors of testers at the laboratory's own constants, after the best common rescaling (median): two discretisations
/// of one truth, with the scatter of the replicates in it.
struct ErrorFloor {
  double modulus = 0.0, toughness = 0.0, toughness_spearman = 0.0;
};
ErrorFloor floor_of(const StudyCase& study_case, sysid::LocalSimulator& simulator,
                    const std::function<void()>& may_go_on);

}  // namespace nacre::calibration_study
