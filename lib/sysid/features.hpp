#pragma once
// Features of a toughness test, log T and log peak stress, and their variances:
// scatter^2 / replicates + floor^2.

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "measurement/summary.hpp"
#include "sysid/discretisation_floor.hpp"
#include "sysid/prediction.hpp"

namespace nacre::sysid {

/// Natural logarithms of toughness and of the largest stress of a curve (both in Pa).
struct CurveFeatures {
  double log_toughness = 0.0;
  double log_peak = 0.0;
};

/// Nothing when the test failed. Without a curve the peak is taken to go with the square root of the toughness.
std::optional<CurveFeatures> features_of(const Prediction& prediction);

/// Largest stress of the curve that stands for the replicates, in Pa; nothing when none was recorded.
std::optional<double> peak_of(const measurement::Replicates& measured);

/// Standard deviations of natural logarithms between replicates of one design, pooled over all designs that have
/// several.
struct RelativeScatter {
  double log_modulus = 0.0, log_toughness = 0.0;
  int modulus_freedom = 0, toughness_freedom = 0;  ///< 0: assumed
};
/// `otherwise` where no design was measured twice.
RelativeScatter pooled_relative_scatter(const std::vector<measurement::Replicates>& measured,
                                        const RelativeScatter& otherwise = {0.01, 0.05});

/// Variance of the mean log E and log T of one design: scatter over its replicates, and discretisation floor.
double modulus_variance(const measurement::Replicates& measured, const RelativeScatter& scatter,
                        const DiscretisationFloor& floor);
double toughness_variance(const measurement::Replicates& measured, const RelativeScatter& scatter,
                          const DiscretisationFloor& floor);
/// The peak is that of one specimen.
double peak_variance(const RelativeScatter& scatter, const DiscretisationFloor& floor);

}  // namespace nacre::sysid
