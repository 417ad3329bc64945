#include "sysid/spread.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::sysid {
double noise_variance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights,
                      double smallest_residual) {
  const double smallest = smallest_residual * smallest_residual;
  const Eigen::Index rows = (weights.array() > 0.0).count();
  if (rows == 0) return smallest;
  const double freedom = std::max(1.0, static_cast<double>(rows - jacobian.cols()));
  const double variance =
      residuals.cwiseProduct(weights).dot(residuals) / weights.sum() * static_cast<double>(rows) / freedom;
  return std::max(variance, smallest);
}

std::vector<double> parameter_deviations(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                         const Eigen::VectorXd& weights, double smallest_residual,
                                         const Eigen::MatrixXd& systematic) {
  if ((weights.array() <= 0.0).all()) return std::vector<double>(jacobian.cols(), kUnknownDeviation);
  const double noise = noise_variance(jacobian, residuals, weights, smallest_residual);
  Eigen::MatrixXd information = jacobian.transpose() * weights.asDiagonal() * jacobian / noise;
  information.diagonal().array() += kUnknownPrecision;
  Eigen::MatrixXd covariance = information.llt().solve(Eigen::MatrixXd::Identity(jacobian.cols(), jacobian.cols()));
  const Eigen::MatrixXd gains = covariance * jacobian.transpose() * weights.asDiagonal();
  for (Eigen::Index k = 0; k < systematic.cols(); ++k) {
    const Eigen::VectorXd gain = gains * systematic.col(k) / noise;
    covariance += gain * gain.transpose();
  }
  std::vector<double> deviations;
  for (Eigen::Index j = 0; j < covariance.cols(); ++j) deviations.push_back(std::sqrt(covariance(j, j)));
  return deviations;
}

double freedom_taken(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weights, double prior_precision,
                     Eigen::Index rows) {
  const Eigen::MatrixXd weighted = jacobian.transpose() * weights.asDiagonal();
  Eigen::MatrixXd information = weighted * jacobian;
  information.diagonal().array() += prior_precision;
  const Eigen::MatrixXd gains = information.llt().solve(weighted);
  return jacobian.topRows(rows).cwiseProduct(gains.leftCols(rows).transpose()).sum();
}

}  // namespace nacre::sysid
