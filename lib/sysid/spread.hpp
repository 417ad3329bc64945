#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace nacre::sysid {

/// Standard deviation of a coordinate of the unit cube of which nothing is known but that it lies there: 1 / sqrt(12).
inline constexpr double kUnknownDeviation = 0.28867513459481287;

/// Standard deviations of the parameters (unit cube) at a least-squares solution: (J' W J / s^2 + 12 I)^-1, where the
/// second term is what the ranges say and s^2 the weighted residual variance with the lost degrees of freedom given
/// back. Misfit of the model counts as noise. `jacobian` is residuals x parameters that were searched; s is at least
/// `smallest_residual`. A row that is missing has the weight 0, and counts nowhere.
/// Each column of `systematic` is an error that all residuals share, of normal size 1: parameters take it over, so that
/// the residuals do not show it and many designs do not average it away.
std::vector<double> parameter_deviations(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                         const Eigen::VectorXd& weights, double smallest_residual,
                                         const Eigen::MatrixXd& systematic = {});

}  // namespace nacre::sysid
