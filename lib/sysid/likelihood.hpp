#pragma once
// The likelihood form besides objective (2.8): residuals r = log(simulated / measured) with covariance C of replicates
// and discretisation floor; deviance r' C^-1 r + log det C, and the F test of chi squared.

#include <vector>

#include "measurement/summary.hpp"
#include "sysid/discretisation_floor.hpp"
#include "sysid/prediction.hpp"

namespace nacre::sysid {

/// Whether residuals are of the size that replicates and the discretisation floor explain.
struct GoodnessOfFit {
  int count = 0;    ///< designs; 0: nothing to judge
  int freedom = 0;  ///< designs less the degrees of freedom that the fit took from them; 0: less than one, not tested
  double chi_squared = 0.0;  ///< squared residuals of log E or log T over their variances, the floor included
  double chi_squared_replicates = 0.0;  ///< the same against the scatter of replicates alone
  double p_value = 1.0;                 ///< chance of so large a chi squared when the model is right; 1 when not tested
  bool tested() const { return freedom > 0; }
  bool misfit() const { return count > 0 && p_value < 0.01; }
  bool operator==(const GoodnessOfFit&) const = default;
};

struct Likelihood {
  double deviance = 0.0;  ///< -2 log likelihood, constants left out
  GoodnessOfFit fit;
};

/// Residuals of log E or log T of the designs that were measured and simulated; `freedom_taken`: what the fit
/// took from these data (ParameterFit::freedom_taken). Their covariance is that of replicates (pooled over designs) and
/// floor, with what the latter shifts in all designs at once (shared_errors.hpp), and the deviance contains its
/// determinant's logarithm. Few replicates say little of the scatter: the chance of so large a chi squared is that of
/// an F.
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
