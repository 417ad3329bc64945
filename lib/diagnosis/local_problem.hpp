#pragma once
// The least squares of a fit near it, by its local model.

#include <Eigen/Dense>
#include <vector>

#include "diagnosis/fit.hpp"
#include "diagnosis/local_model.hpp"

namespace nacre::diagnosis {

class LocalProblem {
 public:
  /// Over the coordinates that are not `held`; `past`: points that were simulated, the latest last. Refers to `fit`,
  /// `values` and `whitener`.
  LocalProblem(const FittedModel& fit, const Eigen::VectorXd& values, const Whitener& whitener,
               const std::vector<int>& held, const std::vector<KnownPoint>& past);
  /// Coordinates of the least local chi squared + damping sum of (scale (u - u of the fit))^2, inside the bounds; the
  /// scale of a coordinate is what a step of 1 does to the whitened rows and the prior.
  Eigen::VectorXd minimum(double damping, double tolerance) const;
  /// chi squared there by the local model.
  double chi2(const Eigen::VectorXd& u) const;

 private:
  double objective(const Eigen::VectorXd& u, double damping) const;
  Eigen::VectorXd step_from(const Eigen::VectorXd& u, double damping) const;

  const FittedModel& fit_;
  const Eigen::VectorXd& values_;
  const Whitener& whitener_;
  Eigen::VectorXd scale_;
  LocalModel local_;
  std::vector<int> free_;
};

}  // namespace nacre::diagnosis
