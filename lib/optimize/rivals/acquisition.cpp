#include "optimize/rivals/acquisition.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/statistics.hpp"
#include "optimize/rivals/unit_cube.hpp"
#include "optimize/sobol.hpp"

namespace nacre::optimize {
namespace {

constexpr int kSlopePoints = 500;
constexpr double kLeastSlope = 1e-7;
constexpr double kSlopeWhenFlat = 10.0;
constexpr double kLeastDeviation = 1e-9;
constexpr double kTail = -10.0;  // where the expectation is a difference of nearly equal numbers

double log_normal_density(double z) { return -0.5 * z * z - 0.5 * std::log(2.0 * std::numbers::pi); }

double steepest_slope(const GaussianProcess& process, std::uint64_t seed) {
  const int dimension = process.kernel().lengths.size();
  double largest = 0.0;
  SobolPoints points(dimension, seed);
  for (int k = 0; k < kSlopePoints; ++k)
    largest = std::max(largest, process.mean_gradient(to_vector(points.next())).norm());
  const Eigen::MatrixXd& known = process.observations().inputs;
  for (Eigen::Index i = 0; i < known.rows(); ++i) {
    largest = std::max(largest, process.mean_gradient(known.row(i).transpose()).norm());
  }
  return largest > kLeastSlope ? largest : kSlopeWhenFlat;
}

}  // namespace

double log_expected_improvement(double z) {
  if (z > kTail) return std::log(std::exp(log_normal_density(z)) + z * normal_cdf(z));
  const double s = 1.0 / (z * z);  // asymptotic series of 1 - |z| Phi / phi
  return log_normal_density(z) + std::log(s) + std::log1p(s * (-3.0 + s * (15.0 + s * (-105.0 + 945.0 * s))));
}

double log_normal_cdf(double z) {
  if (z > kTail) return std::log(normal_cdf(z));
  const double s = 1.0 / (z * z);
  return log_normal_density(z) - std::log(-z) + std::log1p(s * (-1.0 + s * (3.0 + s * (-15.0 + 105.0 * s))));
}

PenalisedImprovement::PenalisedImprovement(const GaussianProcess& process, double incumbent, double margin,
                                           std::uint64_t seed)
    : process_(process),
      threshold_(incumbent - margin * process.kernel().signal_deviation),
      smallest_(process.observations().values.minCoeff()),
      lipschitz_(steepest_slope(process, seed)) {}

void PenalisedImprovement::add_pending(const Eigen::VectorXd& at) { pending_.push_back({at, process_.predict(at)}); }

double PenalisedImprovement::operator()(const Eigen::VectorXd& at) const { return (*this)(at, process_.predict(at)); }

double PenalisedImprovement::operator()(const Eigen::VectorXd& at,
                                        const GaussianProcess::PosteriorValue& predicted) const {
  const double deviation = std::max(predicted.deviation, kLeastDeviation);
  double value = std::log(deviation) + log_expected_improvement((threshold_ - predicted.mean) / deviation);
  for (const Pending& other : pending_) {
    // The minimum lies at least (mean - smallest) / slope away from the pending point, as far as that is known.
    const double reach = lipschitz_ * (at - other.at).norm() - (other.predicted.mean - smallest_);
    value += log_normal_cdf(reach / std::max(other.predicted.deviation, kLeastDeviation));
  }
  return value;
}

}  // namespace nacre::optimize
