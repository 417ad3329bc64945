#pragma once
// The likelihood form beside objective (2.8): residuals of logarithms against the scatter of replicates and the
// numerics floor.

#include "sysid/calibration.hpp"

namespace nacre::sysid {

struct Likelihood {
  double deviance = 0.0;  ///< -2 log likelihood, constants left out
  GoodnessOfFit fit;
};

/// Residuals of log E or log T of the designs that were measured and simulated; `determined`: parameters that these
/// data determine. Their covariance is that of replicates (pooled over designs) and floor, and the deviance contains
/// its logarithm.
Likelihood modulus_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                 const std::vector<Prediction>& predictions, const NumericsFloor& floor,
                                 int determined);
Likelihood toughness_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions, const NumericsFloor& floor,
                                   int determined);

/// Chance that chi squared with this many degrees of freedom is at least `value` (Wilson and Hilferty's cube root;
/// within 0.002).
double chi_squared_tail(double value, int freedom);

}  // namespace nacre::sysid
