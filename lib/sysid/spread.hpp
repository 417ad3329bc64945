#pragma once
// Uncertainty of a weighted least-squares fit over the unit cube: covariance (J' W J / s^2 + 12 I)^-1.

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace nacre::sysid {

/// Standard deviation of a coordinate of the unit cube of which nothing is known but that it lies there: 1 / sqrt(12).
inline constexpr double kUnknownDeviation = 0.28867513459481287;
inline constexpr double kUnknownPrecision = 1.0 / (kUnknownDeviation * kUnknownDeviation);

/// s^2, the weighted residual variance with the lost degrees of freedom given back; s is at least `smallest_residual`.
/// Misfit of the model counts as noise. `jacobian` is residuals x parameters that were searched. A row that is missing
/// has the weight 0, and counts nowhere.
double noise_variance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights,
                      double smallest_residual);

/// Standard deviations of the parameters (unit cube) at a least-squares solution: (J' W J / s^2 + 12 I)^-1, where the
/// second term is the information of the ranges and s^2 is noise_variance().
/// Each column of `systematic` is an error that all residuals share, of normal size 1: parameters absorb it, so that
/// the residuals do not show it and many designs do not average it away.
std::vector<double> parameter_deviations(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                         const Eigen::VectorXd& weights, double smallest_residual,
                                         const Eigen::MatrixXd& systematic = {});

/// Degrees of freedom that a fit takes from its first `rows` residuals: the trace over them of its hat matrix
/// H = J (J' W J + p I)^-1 J' W, where p is the precision of its prior, or the strength of its pull to the start. A
/// parameter that those determine better than the data do, or that is collinear with others, takes less than one.
double freedom_taken(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weights, double prior_precision,
                     Eigen::Index rows);

}  // namespace nacre::sysid
