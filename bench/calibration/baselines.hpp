#pragma once
// What a prediction has to beat, and what it cannot.

#include "case.hpp"

namespace nacre::calibration_study {

/// Mean relative errors on the held-out designs.
struct Baselines {
  double modulus_line = 0.0;        ///< E linear in rigid fraction, least squares on the fitted designs
  double toughness_constant = 0.0;  ///< the fitted designs' median T
  double toughness_line = 0.0;      ///< log T linear in rigid fraction
  double line_spearman = 0.0;
};
Baselines baselines_of(const Case& study_case);

/// What testers at the laboratory's own constants would miss: two numerics of one truth after the best common rescaling
/// (median), with the scatter of the replicates in it.
struct Floor {
  double modulus = 0.0, toughness = 0.0, toughness_spearman = 0.0;
};
Floor floor_of(const Case& study_case, sysid::LocalSimulator& simulator, const std::function<void()>& may_go_on);

}  // namespace nacre::calibration_study
