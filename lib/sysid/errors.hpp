#pragma once
// Relative errors |simulated - measured| / measured over a set of designs (Tables 3.5, A.3, A.4).

#include <vector>

#include "measurement/summary.hpp"
#include "sysid/prediction.hpp"

namespace nacre::sysid {

/// Mean and largest error. A count of 0: nothing to compare, errors 0.
struct PredictionErrors {
  int modulus_count = 0;
  double modulus_mean = 0.0, modulus_max = 0.0;
  int toughness_count = 0;
  double toughness_mean = 0.0, toughness_max = 0.0;
  double toughness_spearman = 0.0;  ///< 0 below three designs
  bool operator==(const PredictionErrors&) const = default;
};

/// Errors of predictions[i] on measured[i]; measurement-side extensions must already be in the predictions.
PredictionErrors prediction_errors(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions);

}  // namespace nacre::sysid
