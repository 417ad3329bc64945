#pragma once
// The likelihood form beside objective (2.8): residuals of logarithms against the scatter of replicates and the
// numerics floor.

#include "sysid/calibration.hpp"

namespace nacre::sysid {

struct Likelihood {
  double deviance = 0.0;  ///< -2 log likelihood, constants left out
  GoodnessOfFit fit;
};

/// Residuals of log E or log T of the designs that were measured and simulated; `freedom_taken`: what the fit
/// took from these data (Fit::freedom_taken). Their covariance is that of replicates (pooled over designs) and floor,
/// with what the latter shifts in all designs at once (shared_errors.hpp), and the deviance contains its determinant's
/// logarithm. Few replicates say little of the scatter: the chance of so large a chi squared is that of an F.
Likelihood modulus_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                 const std::vector<Prediction>& predictions, const DiscretisationFloor& floor,
                                 double freedom_taken);
Likelihood toughness_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions, const DiscretisationFloor& floor,
                                   double freedom_taken);

/// Chance that F with these degrees of freedom is at least `value` (Paulson's cube roots; within 0.002 from ten
/// degrees below on; with fewer too large, so that less is called a misfit).
double f_tail(double value, double freedom_above, double freedom_below);

}  // namespace nacre::sysid
