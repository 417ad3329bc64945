#pragma once
// Changes of the features of a fracture test when the elements are halved: means and covariances after a base refit.

#include <Eigen/Dense>
#include <string>

#include "floor_rows.hpp"
#include "modulus_floor.hpp"

namespace nacre::discretisation_floor {

/// log E, log T, log peak stress, log failure strain.
inline constexpr int kFeatures = 4;
inline constexpr const char* kFeatureNames[kFeatures] = {"log_modulus", "log_toughness", "log_peak",
                                                         "log_failure_strain"};
using FeatureMatrix = Eigen::Matrix<double, kFeatures, kFeatures>;
using FeatureVector = Eigen::Matrix<double, kFeatures, 1>;

/// Changes of the features of a fracture test (and of E beside it) when the elements are halved, after a base refit: of
/// the six constants for E; for the others of the common scales of all moduli and of all failure energies, whose effect
/// dimensional analysis gives (T with W; stress with sqrt(E W); strain with sqrt(W / E)).
struct ToughnessFloor {
  int pairs = 0, layouts = 0, sets = 0, failed = 0;
  FeatureVector mean, sd;     ///< feature(h/2) - feature(h) before the refit; sd after one common factor per set
  FeatureMatrix of_finite_n;  ///< what the finite number of specimens adds to the covariance of a layout: taken off
  double spearman = 0.0;      ///< of T, mean over the parameter sets
  double at_sd[2] = {};       ///< of log T below and from 75 % rigid
  /// Covariance of the residuals between layouts i and j with z = (rigid fraction - 0.675) / 0.1:
  /// shared + z_i z_j rigid + (i = j) layout.
  FeatureMatrix shared, rigid, layout;
  double same_layout = 0.0;  ///< correlation of log T between parameter sets of one layout; 0 when never repeated
  int repeated = 0;          ///< pairs of parameter sets behind it
};

ToughnessFloor toughness_floor(const FloorPlan& plan, const study::StudyTable& table, const ModulusFloor& moduli);
std::string to_toml(const ToughnessFloor& floor);

}  // namespace nacre::discretisation_floor
