#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sysid/objective.hpp"
#include "sysid/recorded_fit.hpp"
#include "sysid/spread.hpp"

namespace nacre::sysid {
namespace {

/// Cost of moving every parameter across its whole range, as relative error: far below what any data with noise say.
constexpr double kPull = 0.002;
constexpr double kDifference = 0.02;      // of a parameter's range; the static tester is smooth
constexpr double kSmallResidual = 0.01;   // below 1 % a residual counts quadratically, above by its magnitude
constexpr double kLeastGain = 1e-3;       // relative gain in objective below which the fit has converged
constexpr double kSmallestNoise = 0.002;  // of log E, when deviations are told: no data are better
constexpr double kFailedResidual = 1.0;

class ModulusFit final : public RecordedFit {
 public:
  ModulusFit(FitData data, const FitSettings& settings) : RecordedFit(std::move(data), settings, kPull) {}

  std::vector<Point> ask() override {
    if (asked_.empty() && !finished_) asked_ = propose();
    return asked_;
  }

  void tell(std::vector<std::vector<Prediction>> predictions) override {
    const std::size_t first_new = trials_.size();
    for (std::size_t k = 0; k < asked_.size(); ++k) add_trial(asked_[k], std::move(predictions[k]));
    asked_.clear();
    if (first_new == 0) return;
    if (differencing_) {
      take_jacobian(first_new);
    } else {
      judge_steps();
    }
  }

  std::vector<double> deviations() const override {
    if (jacobian_.size() == 0) return std::vector<double>(settings_.start.size(), kUnknownDeviation);
    return parameter_deviations(jacobian_, residuals(trials_[best_]),
                                Eigen::Map<const Eigen::VectorXd>(data_.weights.data(), residual_.size()),
                                kSmallestNoise);
  }

 private:
  int dimension() const { return static_cast<int>(settings_.start.size()); }
  int budget_left() const { return settings_.budget - static_cast<int>(trials_.size()); }
  void add_trial(const Point& point, std::vector<Prediction> predictions) {
    const double objective = modulus_objective(data_.measured, data_.weights, predictions);
    record(point, std::move(predictions), objective);
  }

  std::vector<Point> propose() {
    if (trials_.empty()) return {settings_.start};
    // A Jacobian without a step after it would be wasted.
    if (differencing_ && budget_left() <= dimension()) finished_ = true;
    if (budget_left() <= 0) finished_ = true;
    if (finished_) return {};
    return differencing_ ? difference_points() : step_points();
  }

  std::vector<Point> difference_points() {
    centre_ = best_;
    std::vector<Point> points;
    for (int j = 0; j < dimension(); ++j) {
      Point point = trials_[centre_].point;
      const std::size_t index = static_cast<std::size_t>(j);
      point[index] += point[index] > 0.5 ? -kDifference : kDifference;
      points.push_back(std::move(point));
    }
    return points;
  }

  /// log E_simulated - log E_measured per design.
  Eigen::VectorXd residuals(const Trial& trial) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(data_.measured.size()));
    for (std::size_t i = 0; i < data_.measured.size(); ++i) {
      const std::optional<double>& modulus = trial.predictions[i].modulus_pa;
      const bool usable = modulus && *modulus > 0.0;
      result[static_cast<Eigen::Index>(i)] =
          usable ? std::log(*modulus / data_.measured[i].modulus_pa) : kFailedResidual;
    }
    return result;
  }

  void take_jacobian(std::size_t first_new) {
    const Trial& centre = trials_[centre_];
    residual_ = residuals(centre);
    jacobian_.resize(residual_.size(), dimension());
    for (int j = 0; j < dimension(); ++j) {
      const std::size_t index = static_cast<std::size_t>(j);
      const Trial& moved = trials_[first_new + index];
      jacobian_.col(j) = (residuals(moved) - residual_) / (moved.point[index] - centre.point[index]);
    }
    for (Eigen::Index i = 0; i < residual_.size(); ++i) {  // a failed simulation has no slope
      if (residual_[i] == kFailedResidual) jacobian_.row(i).setZero();
    }
    differencing_ = false;
    damping_ = kFirstDamping;
    start_cost_ = cost(centre);
  }

  /// Steps of several dampings, from bold to cautious, so that one batch holds a good one.
  std::vector<Point> step_points() {
    std::vector<Point> points;
    const int count = std::min(std::max(1, settings_.batch), budget_left());
    for (int k = 0; k < count; ++k, damping_ *= 10.0) points.push_back(damped_step(damping_));
    return points;
  }

  Point damped_step(double damping) const {
    const Trial& centre = trials_[centre_];
    Eigen::VectorXd weight(residual_.size());
    double weight_sum = 0.0;
    for (Eigen::Index i = 0; i < weight.size(); ++i) {
      const double sample = data_.weights[static_cast<std::size_t>(i)];
      weight_sum += sample;
      weight[i] = sample / std::max(std::abs(residual_[i]), kSmallResidual);
    }
    Eigen::MatrixXd normal = jacobian_.transpose() * weight.asDiagonal() * jacobian_ / weight_sum;
    Eigen::VectorXd gradient = jacobian_.transpose() * weight.asDiagonal() * residual_ / weight_sum;
    const double pull = 2.0 * kPull / dimension();
    for (int j = 0; j < dimension(); ++j) {
      const std::size_t index = static_cast<std::size_t>(j);
      gradient[j] += pull * (centre.point[index] - settings_.start[index]);
      normal(j, j) += pull;
      normal(j, j) *= 1.0 + damping;
    }
    return bounded_step(normal, gradient, centre.point);
  }

  /// Minimises the quadratic model within the cube: parameters that the free step pushes through a face are fixed on it
  /// and the rest solved again (at most once per dimension).
  Point bounded_step(const Eigen::MatrixXd& normal, const Eigen::VectorXd& gradient, const Point& from) const {
    const int n = dimension();
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
    std::vector<bool> fixed(static_cast<std::size_t>(n), false);
    for (int round = 0; round <= n; ++round) {
      Eigen::MatrixXd system = normal;
      Eigen::VectorXd right = -gradient;
      for (int j = 0; j < n; ++j) {
        if (!fixed[static_cast<std::size_t>(j)]) continue;
        right -= normal.col(j) * step[j];
      }
      for (int j = 0; j < n; ++j) {
        if (!fixed[static_cast<std::size_t>(j)]) continue;
        system.row(j).setZero();
        system.col(j).setZero();
        system(j, j) = 1.0;
        right[j] = step[j];
      }
      step = system.ldlt().solve(right);
      bool all_inside = true;
      for (int j = 0; j < n; ++j) {
        const std::size_t index = static_cast<std::size_t>(j);
        const double target = from[index] + step[j];
        if (fixed[index] || (target >= 0.0 && target <= 1.0)) continue;
        fixed[index] = true;
        step[j] = std::clamp(target, 0.0, 1.0) - from[index];
        all_inside = false;
      }
      if (all_inside) break;
    }
    Point point = from;
    for (int j = 0; j < n; ++j) {
      const std::size_t index = static_cast<std::size_t>(j);
      point[index] = std::clamp(from[index] + step[j], 0.0, 1.0);
    }
    return point;
  }

  void judge_steps() {
    const double gain = start_cost_ - cost(trials_[best_]);
    if (best_ != centre_ && gain > kLeastGain * start_cost_) {
      differencing_ = true;
    } else if (best_ != centre_ || damping_ > kLastDamping) {
      finished_ = true;
    }
  }

  static constexpr double kFirstDamping = 1e-3, kLastDamping = 1e2;

  std::size_t centre_ = 0;
  Eigen::MatrixXd jacobian_;
  Eigen::VectorXd residual_;
  double damping_ = kFirstDamping;
  double start_cost_ = 0.0;
  bool differencing_ = true;
};

}  // namespace

double pull_to_start(std::span<const double> point, std::span<const double> start, double strength) {
  double sum = 0.0;
  for (std::size_t j = 0; j < point.size(); ++j) sum += (point[j] - start[j]) * (point[j] - start[j]);
  return point.empty() ? 0.0 : strength * sum / static_cast<double>(point.size());
}

std::unique_ptr<Fit> make_modulus_fit(FitData data, const FitSettings& settings) {
  return std::make_unique<ModulusFit>(std::move(data), settings);
}

}  // namespace nacre::sysid
