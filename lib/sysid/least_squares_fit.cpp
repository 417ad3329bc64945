#include "sysid/least_squares_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "sysid/emulator.hpp"
#include "sysid/objective.hpp"
#include "sysid/recorded_fit.hpp"
#include "sysid/shared_errors.hpp"
#include "sysid/spread.hpp"

namespace nacre::sysid {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr double kConvergedGain = 1e-3;  // relative gain in cost below which the fit has converged

/// The least-squares problem of one tester's parameters.
struct LeastSquaresProblem {
  std::function<double(const std::vector<Prediction>&)> objective;
  /// Natural logarithms of simulated over measured values; not a number where a simulation failed or nothing was
  /// measured.
  std::function<Eigen::VectorXd(const std::vector<Prediction>&)> residuals;
  Eigen::VectorXd weights;            ///< of the residuals
  Eigen::MatrixXd shared;             ///< errors that all residuals share (spread.hpp)
  std::vector<std::size_t> searched;  ///< coordinates of the point that move
  double difference = 0.0;            ///< of a coordinate, for slopes
  double pull = 0.0;                  ///< cost of moving every parameter across its whole range
  double small_residual = 0.01;       ///< below it a residual counts quadratically, above by its magnitude
  double smallest_noise = 0.002;      ///< when deviations are computed: no data are better
};

class LeastSquaresFit final : public RecordedFit {
 public:
  LeastSquaresFit(FitData data, const FitSettings& settings, LeastSquaresProblem problem)
      : RecordedFit(std::move(data), settings, problem.pull), problem_(std::move(problem)) {}

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
    std::vector<double> result(settings_.start.size(), kUnknownDeviation);
    if (jacobian_.size() == 0) return result;
    const FitTrial& at = trials_[best_];
    const std::vector<double> searched =
        parameter_deviations(jacobian_, residuals(at), weights(at), problem_.smallest_noise, problem_.shared);
    for (std::size_t j = 0; j < searched.size(); ++j) result[problem_.searched[j]] = searched[j];
    return result;
  }

  double freedom_taken() const override {
    if (jacobian_.size() == 0) return 0.0;
    const FitTrial& at = trials_[best_];
    return freedom_taken_by(problem_.searched, jacobian_, reweighted(weights(at), residuals(at)),
                            pull() * sum_of_weights());
  }

 private:
  int dimension() const { return problem_.searched.size(); }
  std::size_t coordinate(int j) const { return problem_.searched[j]; }
  int budget_left() const { return settings_.budget - static_cast<int>(trials_.size()); }
  void add_trial(const Point& point, std::vector<Prediction> predictions) {
    const double objective = problem_.objective(predictions);
    record(point, std::move(predictions), objective);
  }

  std::vector<Point> propose() override {
    if (trials_.empty()) return {settings_.start};
    // A Jacobian without a step after it would be wasted.
    if (budget_left() <= (differencing_ ? dimension() : 0)) return {};
    return differencing_ ? difference_points() : step_points();
  }

  std::vector<Point> difference_points() {
    centre_ = best_;
    std::vector<Point> points;
    for (int j = 0; j < dimension(); ++j) {
      Point point = trials_[centre_].point;
      const std::size_t index = coordinate(j);
      point[index] += point[index] > 0.5 ? -problem_.difference : problem_.difference;
      points.push_back(std::move(point));
    }
    return points;
  }

  /// 0 where there is none: it pulls nowhere.
  Eigen::VectorXd residuals(const FitTrial& trial) const {
    return problem_.residuals(trial.predictions).unaryExpr([](double value) {
      return std::isnan(value) ? 0.0 : value;
    });
  }

  /// 0 where there is no residual.
  Eigen::VectorXd weights(const FitTrial& trial) const {
    const Eigen::VectorXd residuals = problem_.residuals(trial.predictions);
    return residuals.array().isNaN().select(0.0, problem_.weights);
  }

  /// Towards the absolute error of (2.8): least squares of what is left of each residual.
  Eigen::VectorXd reweighted(const Eigen::VectorXd& weights, const Eigen::VectorXd& residuals) const {
    return weights.cwiseQuotient(residuals.cwiseAbs().cwiseMax(problem_.small_residual));
  }

  /// One by one: the order of a sum decides its last bit.
  double sum_of_weights() const { return std::accumulate(problem_.weights.begin(), problem_.weights.end(), 0.0); }
  /// Second derivative of the pull to the start, the cost being a mean over the weights.
  double pull() const { return 2.0 * problem_.pull / dimension(); }

  void take_jacobian(std::size_t first_new) {
    const FitTrial& centre = trials_[centre_];
    residual_ = residuals(centre);
    jacobian_.resize(residual_.size(), dimension());
    for (int j = 0; j < dimension(); ++j) {
      const std::size_t index = coordinate(j);
      const FitTrial& moved = trials_[first_new + static_cast<std::size_t>(j)];
      const Eigen::VectorXd change = problem_.residuals(moved.predictions) - problem_.residuals(centre.predictions);
      jacobian_.col(j) = change.unaryExpr([](double value) { return std::isnan(value) ? 0.0 : value; }) /
                         (moved.point[index] - centre.point[index]);
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
    const FitTrial& centre = trials_[centre_];
    const Eigen::VectorXd weight = reweighted(problem_.weights, residual_);
    const double weight_sum = sum_of_weights();
    Eigen::MatrixXd normal = jacobian_.transpose() * weight.asDiagonal() * jacobian_ / weight_sum;
    Eigen::VectorXd gradient = jacobian_.transpose() * weight.asDiagonal() * residual_ / weight_sum;
    for (int j = 0; j < dimension(); ++j) {
      gradient[j] += pull() * (centre.point[coordinate(j)] - settings_.start[coordinate(j)]);
      normal(j, j) += pull();
      normal(j, j) *= 1.0 + damping;
    }
    return bounded_step(normal, gradient, centre.point);
  }

  /// Minimises the quadratic model within the cube: parameters that the free step pushes through a face are fixed on it
  /// and the rest solved again (at most once per dimension).
  Point bounded_step(const Eigen::MatrixXd& normal, const Eigen::VectorXd& gradient, const Point& from) const {
    const int n = dimension();
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
    std::vector<bool> fixed(n, false);
    for (int round = 0; round <= n; ++round) {
      Eigen::MatrixXd system = normal;
      Eigen::VectorXd right = -gradient;
      for (int j = 0; j < n; ++j) {
        if (!fixed[j]) continue;
        right -= normal.col(j) * step[j];
      }
      for (int j = 0; j < n; ++j) {
        if (!fixed[j]) continue;
        system.row(j).setZero();
        system.col(j).setZero();
        system(j, j) = 1.0;
        right[j] = step[j];
      }
      step = system.ldlt().solve(right);
      bool all_inside = true;
      for (int j = 0; j < n; ++j) {
        const double target = from[coordinate(j)] + step[j];
        if (fixed[j] || (target >= 0.0 && target <= 1.0)) continue;
        fixed[j] = true;
        step[j] = std::clamp(target, 0.0, 1.0) - from[coordinate(j)];
        all_inside = false;
      }
      if (all_inside) break;
    }
    Point point = from;
    for (int j = 0; j < n; ++j) {
      point[coordinate(j)] = std::clamp(from[coordinate(j)] + step[j], 0.0, 1.0);
    }
    return point;
  }

  void judge_steps() {
    const double gain = start_cost_ - cost(trials_[best_]);
    if (best_ != centre_ && gain > kConvergedGain * start_cost_) {
      differencing_ = true;
    } else if (best_ != centre_ || damping_ > kLastDamping) {
      finished_ = true;
    }
  }

  static constexpr double kFirstDamping = 1e-3, kLastDamping = 1e2;

  LeastSquaresProblem problem_;
  std::size_t centre_ = 0;
  Eigen::MatrixXd jacobian_;
  Eigen::VectorXd residual_;
  double damping_ = kFirstDamping;
  double start_cost_ = 0.0;
  bool differencing_ = true;
};

}  // namespace

std::unique_ptr<ParameterFit> make_modulus_fit(FitData data, const FitSettings& settings) {
  LeastSquaresProblem problem;
  problem.weights = Eigen::Map<const Eigen::VectorXd>(data.weights.data(), data.weights.size());
  problem.objective = [data](const std::vector<Prediction>& predictions) {
    return modulus_objective(data.measured, data.weights, predictions);
  };
  problem.residuals = [data](const std::vector<Prediction>& predictions) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(data.measured.size()));
    for (std::size_t i = 0; i < data.measured.size(); ++i) {
      const std::optional<double>& modulus = predictions[i].modulus_pa;
      const bool usable = modulus && *modulus > 0.0;
      result[i] = usable ? std::log(*modulus / data.measured[i].modulus_pa) : kMissing;
    }
    return result;
  };
  problem.shared = shared_modulus_errors(data.measured, settings.floor);
  for (std::size_t j = 0; j < settings.start.size(); ++j) problem.searched.push_back(j);
  problem.difference = 0.02;  // the static tester is smooth
  problem.pull = 0.002;       // far below the information of any data with noise
  return std::make_unique<LeastSquaresFit>(std::move(data), settings, std::move(problem));
}

std::unique_ptr<ParameterFit> make_gauss_newton_fit(FitData data, const FitSettings& settings) {
  const Eigen::Index designs = data.measured.size();
  LeastSquaresProblem problem;
  problem.weights.resize(2 * designs);
  for (Eigen::Index i = 0; i < designs; ++i) problem.weights[i] = problem.weights[designs + i] = data.weights[i];
  problem.objective = [data](const std::vector<Prediction>& predictions) {
    return toughness_objective(data.measured, data.weights, predictions);
  };
  problem.residuals = [data, designs](const std::vector<Prediction>& predictions) {
    Eigen::VectorXd result = Eigen::VectorXd::Constant(2 * designs, kMissing);
    for (Eigen::Index i = 0; i < designs; ++i) {
      const measurement::Replicates& measured = data.measured[i];
      const auto simulated = features_of(predictions[i]);
      if (!simulated) continue;
      result[i] = simulated->log_toughness - std::log(measured.toughness_pa);
      if (const auto peak = peak_of(measured)) result[designs + i] = simulated->log_peak - std::log(*peak);
    }
    return result;
  };
  problem.shared = shared_fracture_errors(data.measured, settings.floor);
  problem.searched.assign(kSearchedEta.begin(), kSearchedEta.end());
  problem.difference = 0.08;  // wide enough to step over the jumps of single fractures
  problem.pull = 0.01;
  problem.small_residual = 0.05;
  problem.smallest_noise = 0.03;
  return std::make_unique<LeastSquaresFit>(std::move(data), settings, std::move(problem));
}

}  // namespace nacre::sysid
