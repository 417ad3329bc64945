#pragma once

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

/// What halving the elements does to the features of a fracture test (and to E beside it), after a base refit: the
/// six constants for E; for the others the common scales of all moduli and of all failure energies, whose effect
/// dimensions prescribe (T with W; stress with sqrt(E W); strain with sqrt(W / E)).
struct ToughnessFloor {
  int pairs = 0, layouts = 0, sets = 0, failed = 0;
  FeatureVector mean, sd;  ///< feature(h/2) - feature(h) before the refit; sd after one common factor per set
  double spearman = 0.0;   ///< of T, mean over the parameter sets
  double at_sd[2] = {};    ///< of log T below and from 75 % rigid
  /// Covariance of what is left between layouts i and j with z = (rigid fraction - 0.675) / 0.1:
  /// shared + z_i z_j rigid + (i = j) layout.
  FeatureMatrix shared, rigid, layout;
  double same_layout = 0.0;  ///< correlation of log T between parameter sets of one layout; 0 when never repeated
  int repeated = 0;          ///< pairs of parameter sets behind it
};

ToughnessFloor toughness_floor(const Plan& plan, const study::StudyTable& table, const ModulusFloor& moduli);
std::string to_toml(const ToughnessFloor& floor);

}  // namespace nacre::discretisation_floor
