#include "optimize/rivals/cma_es.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "optimize/recorded_optimizer.hpp"
#include "optimize/rivals/unit_cube.hpp"

namespace nacre::optimize {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFirstSpread = 0.2;
constexpr double kSmallestStep = 1e-5;  // of the whole distribution, before the search restarts
constexpr double kOutside =
    1.0;  // cost per squared distance from the cube, in units of the generation's spread of values

/// Table 1 of the tutorial.
struct Strategy {
  int population;
  VectorXd weights;  ///< of the better half, sum 1
  double mu_eff, c_sigma, d_sigma, c_c, c_1, c_mu, expected_norm;

  Strategy(int n, int lambda) : population(lambda), weights(lambda / 2) {
    for (Eigen::Index i = 0; i < weights.size(); ++i)
      weights[i] = std::log(0.5 * (lambda + 1)) - std::log(static_cast<double>(i) + 1);
    weights /= std::accumulate(weights.begin(), weights.end(), 0.0);
    mu_eff = 1.0 / weights.squaredNorm();
    c_sigma = (mu_eff + 2) / (n + mu_eff + 5);
    d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma;
    c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);
    c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);
    c_mu = std::min(1 - c_1, 2 * (mu_eff - 2 + 1 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff));
    expected_norm = std::sqrt(n) * (1 - 1.0 / (4 * n) + 1.0 / (21.0 * n * n));
  }
};

class CmaEs final : public RecordedOptimizer {
 public:
  explicit CmaEs(const BatchOptimizerSettings& settings)
      : RecordedOptimizer(settings),
        random_(settings.seed, "optimize/cma-es"),
        strategy_(settings.dimension, 4 + static_cast<int>(3 * std::log(settings.dimension))) {}

 private:
  int dimension() const { return settings_.dimension; }

  std::vector<Point> propose(int count) override {
    if (!begun_) begin();
    std::vector<Point> points;
    for (; count > 0 && static_cast<int>(drawn_.size()) < strategy_.population; --count) {
      VectorXd normal(dimension());
      for (double& value : normal) value = random_.normal();
      drawn_.push_back(mean_ + step_ * (axes_ * scales_.cwiseProduct(normal)));
      if (drawn_.size() == 1) first_of_generation_ = told_count() + static_cast<int>(asked_.size());
      points.push_back(to_point(drawn_.back().cwiseMax(0.0).cwiseMin(1.0)));
    }
    return points;
  }

  void told() override {
    if (begun_ && static_cast<int>(drawn_.size()) == strategy_.population) adapt();
  }

  /// From the best point known, or the best guess while none is.
  void begin() {
    begun_ = true;
    mean_ = best()                     ? to_vector(best()->point)
            : settings_.starts.empty() ? VectorXd::Constant(dimension(), 0.5)
                                       : to_vector(settings_.starts.front());
    step_ = kFirstSpread;
    covariance_ = axes_ = MatrixXd::Identity(dimension(), dimension());
    scales_ = VectorXd::Ones(dimension());
    step_path_ = covariance_path_ = VectorXd::Zero(dimension());
    generation_ = 0;
  }

  /// Indices of the generation's points, best first.
  std::vector<std::size_t> ranking() const {
    const std::vector<double> all = values();
    std::vector<double> cost(all.begin() + first_of_generation_,
                             all.begin() + first_of_generation_ + strategy_.population);
    const auto [least, most] = std::minmax_element(cost.begin(), cost.end());
    const double unit = kOutside * (*most - *least);
    std::vector<std::size_t> order(drawn_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      cost[i] += unit * (drawn_[i] - drawn_[i].cwiseMax(0.0).cwiseMin(1.0)).squaredNorm();
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
    return order;
  }

  void adapt() {
    const std::vector<std::size_t> order = ranking();
    VectorXd shift = VectorXd::Zero(dimension());
    MatrixXd rank_mu = MatrixXd::Zero(dimension(), dimension());
    for (Eigen::Index i = 0; i < strategy_.weights.size(); ++i) {
      const VectorXd y = (drawn_[order[i]] - mean_) / step_;
      shift += strategy_.weights[i] * y;
      rank_mu += strategy_.weights[i] * y * y.transpose();
    }
    drawn_.clear();
    mean_ += step_ * shift;
    ++generation_;
    const VectorXd whitened = axes_ * (axes_.transpose() * shift).cwiseQuotient(scales_);
    step_path_ = (1 - strategy_.c_sigma) * step_path_ +
                 std::sqrt(strategy_.c_sigma * (2 - strategy_.c_sigma) * strategy_.mu_eff) * whitened;
    const double settled = std::sqrt(1 - std::pow(1 - strategy_.c_sigma, 2 * generation_));
    const bool moving = step_path_.norm() / settled < (1.4 + 2.0 / (dimension() + 1)) * strategy_.expected_norm;
    covariance_path_ *= 1 - strategy_.c_c;
    if (moving) covariance_path_ += std::sqrt(strategy_.c_c * (2 - strategy_.c_c) * strategy_.mu_eff) * shift;
    const double lost = moving ? 0.0 : strategy_.c_c * (2 - strategy_.c_c);
    covariance_ = (1 - strategy_.c_1 - strategy_.c_mu + strategy_.c_1 * lost) * covariance_ +
                  strategy_.c_1 * covariance_path_ * covariance_path_.transpose() + strategy_.c_mu * rank_mu;
    step_ *= std::exp(strategy_.c_sigma / strategy_.d_sigma * (step_path_.norm() / strategy_.expected_norm - 1));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(covariance_);
    axes_ = eigen.eigenvectors();
    scales_ = eigen.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
    if (step_ * scales_.maxCoeff() > kSmallestStep) return;
    strategy_ = Strategy(dimension(), 2 * strategy_.population);
    begun_ = false;
  }

  RandomStream random_;
  Strategy strategy_;
  bool begun_ = false;
  VectorXd mean_, scales_, step_path_, covariance_path_;
  MatrixXd covariance_, axes_;
  double step_ = kFirstSpread;
  int generation_ = 0, first_of_generation_ = 0;
  std::vector<VectorXd> drawn_;  ///< of this generation, as drawn: also outside the cube
};

}  // namespace

std::unique_ptr<BatchOptimizer> make_cma_es(const BatchOptimizerSettings& settings) {
  return std::make_unique<CmaEs>(settings);
}

}  // namespace nacre::optimize
