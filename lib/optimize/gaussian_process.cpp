#include "optimize/gaussian_process.hpp"

#include <cassert>
#include <cmath>
#include <nlopt.hpp>
#include <numbers>

#include "base/matern.hpp"
#include "base/random.hpp"

namespace nacre::optimize {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// -(dM/da) / a of matern52(): the common factor of the derivatives with respect to lengths and to coordinates.
double matern52_slope(double a) { return (1.0 + a) / 3.0 * std::exp(-a); }

/// Squared distances between the rows of both, times 5.
MatrixXd squared_distances(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd result = -10.0 * a * b.transpose();
  result.colwise() += 5.0 * a.rowwise().squaredNorm();
  result.rowwise() += 5.0 * b.rowwise().squaredNorm().transpose();
  return result.cwiseMax(0.0);
}

}  // namespace

double MaternKernel::operator()(const VectorXd& a, const VectorXd& b) const {
  const double distance = std::sqrt(5.0) * (a - b).cwiseQuotient(lengths).norm();
  return signal_deviation * signal_deviation * matern52(distance);
}

GaussianProcess::GaussianProcess(RegressionData observations, MaternKernel kernel)
    : observations_(std::move(observations)), kernel_(std::move(kernel)) {
  assert(observations_.inputs.rows() == observations_.values.size());
  assert(observations_.inputs.cols() == kernel_.lengths.size());
  if (observations_.noise_variances.size() == 0)
    observations_.noise_variances = VectorXd::Zero(observations_.values.size());
  mean_ = observations_.values.size() > 0 ? observations_.values.mean() : 0.0;
  scaled_ = observations_.inputs * kernel_.lengths.cwiseInverse().asDiagonal();
  factorise();
}

/// Adds to the diagonal, a tenfold each time, until the matrix is positive definite in floating point.
void GaussianProcess::factorise() {
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  const MatrixXd distances = squared_distances(scaled_, scaled_);
  MatrixXd matrix = distances.unaryExpr([signal](double square) { return signal * matern52(std::sqrt(square)); });
  matrix.diagonal().setConstant(signal + kernel_.noise_deviation * kernel_.noise_deviation);
  matrix.diagonal() += observations_.noise_variances;
  constexpr double kFirstJitter = 1e-12, kLastJitter = 1e-3;
  factor_.compute(matrix);
  while (factor_.info() != Eigen::Success && jitter_ < kLastJitter) {
    const double next = jitter_ == 0.0 ? kFirstJitter : 10.0 * jitter_;
    matrix.diagonal().array() += (next - jitter_) * signal;
    jitter_ = next;
    factor_.compute(matrix);
  }
  assert(factor_.info() == Eigen::Success);
  weights_ = factor_.solve(VectorXd(observations_.values.array() - mean_));
}

VectorXd GaussianProcess::covariances(const VectorXd& at) const {
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  const VectorXd from = at.cwiseQuotient(kernel_.lengths);
  return (5.0 * (scaled_.rowwise() - from.transpose()).rowwise().squaredNorm()).unaryExpr([signal](double square) {
    return signal * matern52(std::sqrt(square));
  });
}

GaussianProcess::PosteriorValue GaussianProcess::predict(const VectorXd& at) const {
  const VectorXd k = covariances(at);
  const VectorXd reduced = factor_.matrixL().solve(k);
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  return {mean_ + k.dot(weights_), std::sqrt(std::max(0.0, signal - reduced.squaredNorm()))};
}

MatrixXd GaussianProcess::covariances_all(const MatrixXd& at) const {
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  const MatrixXd from = at * kernel_.lengths.cwiseInverse().asDiagonal();
  return squared_distances(scaled_, from).unaryExpr([signal](double square) {
    return signal * matern52(std::sqrt(square));
  });
}

VectorXd GaussianProcess::means(const MatrixXd& at) const {
  return (covariances_all(at).transpose() * weights_).array() + mean_;
}

std::vector<GaussianProcess::PosteriorValue> GaussianProcess::predict_all(const MatrixXd& at) const {
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  const MatrixXd k = covariances_all(at);
  const VectorXd means = k.transpose() * weights_;
  const MatrixXd reduced = factor_.matrixL().solve(k);
  std::vector<PosteriorValue> predictions;
  for (Index i = 0; i < at.rows(); ++i) {
    const double variance = signal - reduced.col(i).squaredNorm();
    predictions.push_back({mean_ + means[i], std::sqrt(std::max(0.0, variance))});
  }
  return predictions;
}

VectorXd GaussianProcess::mean_gradient(const VectorXd& at) const {
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  VectorXd gradient = VectorXd::Zero(at.size());
  for (Index i = 0; i < weights_.size(); ++i) {
    const VectorXd apart = at - observations_.inputs.row(i).transpose();
    const double a = std::sqrt(5.0) * apart.cwiseQuotient(kernel_.lengths).norm();
    gradient -= 5.0 * signal * weights_[i] * matern52_slope(a) * apart.cwiseQuotient(kernel_.lengths.cwiseAbs2());
  }
  return gradient;
}

double GaussianProcess::log_marginal_likelihood() const {
  const VectorXd centred = observations_.values.array() - mean_;
  const MatrixXd lower = factor_.matrixL();
  return -0.5 * centred.dot(weights_) - lower.diagonal().array().log().sum() -
         0.5 * static_cast<double>(centred.size()) * std::log(2.0 * std::numbers::pi);
}

VectorXd GaussianProcess::log_marginal_gradient() const {
  const Index n = weights_.size(), d = kernel_.lengths.size();
  const double signal = kernel_.signal_deviation * kernel_.signal_deviation;
  const MatrixXd inverse = factor_.solve(MatrixXd::Identity(n, n));
  const MatrixXd pull = weights_ * weights_.transpose() - inverse;  // dL/dK = pull / 2
  const MatrixXd a = squared_distances(scaled_, scaled_).cwiseSqrt();
  VectorXd gradient(d + 2);
  gradient[0] = signal * pull.cwiseProduct(a.unaryExpr([](double x) { return matern52(x); })).sum();
  // dK_ab/dlog l_j = 5 s^2 slope(a) (x_aj - x_bj)^2 / l_j^2; the square of the difference is expanded, so that all j
  // cost one product.
  const MatrixXd share = 5.0 * signal * pull.cwiseProduct(a.unaryExpr([](double x) { return matern52_slope(x); }));
  const VectorXd row_sums = share.rowwise().sum();
  const MatrixXd crossed = share * scaled_;
  for (Index j = 0; j < d; ++j) {
    const auto x = scaled_.col(j);
    gradient[1 + j] = x.cwiseAbs2().dot(row_sums) - x.dot(crossed.col(j));
  }
  gradient[d + 1] = kernel_.noise_deviation * kernel_.noise_deviation * pull.trace();
  return gradient;
}

namespace {

// The prior over the kernel of standardised values; normal in natural logarithms.
constexpr double kSignalCentre = 0.0, kSignalSpread = 1.0;
const double kLengthCentre = std::log(0.7);
constexpr double kLengthSpread = 1.0;
const double kNoiseCentre = std::log(0.1);
constexpr double kNoiseSpread = 1.5;
constexpr double kReach = 3.0;  // bounds of the search, in spreads

struct HyperPrior {
  std::vector<double> centre, spread;
  explicit HyperPrior(Index dimensions)
      : centre(static_cast<std::size_t>(dimensions) + 2, kLengthCentre), spread(centre.size(), kLengthSpread) {
    centre.front() = kSignalCentre;
    spread.front() = kSignalSpread;
    centre.back() = kNoiseCentre;
    spread.back() = kNoiseSpread;
  }
};

MaternKernel kernel_at(const std::vector<double>& logarithms) {
  MaternKernel kernel;
  kernel.signal_deviation = std::exp(logarithms.front());
  kernel.lengths.resize(static_cast<Index>(logarithms.size()) - 2);
  for (Index j = 0; j < kernel.lengths.size(); ++j)
    kernel.lengths[j] = std::exp(logarithms[static_cast<std::size_t>(j) + 1]);
  kernel.noise_deviation = std::exp(logarithms.back());
  return kernel;
}

struct HyperPosterior {
  const RegressionData& observations;
  const HyperPrior& prior;
};

/// Negative log posterior density of a kernel, and its gradient.
double hyper_objective(const std::vector<double>& at, std::vector<double>& gradient, void* data) {
  const HyperPosterior& posterior = *static_cast<HyperPosterior*>(data);
  const GaussianProcess process(posterior.observations, kernel_at(at));
  double value = -process.log_marginal_likelihood();
  const VectorXd slope = gradient.empty() ? VectorXd() : process.log_marginal_gradient();
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double apart = (at[k] - posterior.prior.centre[k]) / posterior.prior.spread[k];
    value += 0.5 * apart * apart;
    if (!gradient.empty()) gradient[k] = apart / posterior.prior.spread[k] - slope[k];
  }
  return value;
}

/// Smallest value that L-BFGS reaches from `at`, which it moves there.
double descend(std::vector<double>& at, HyperPosterior& posterior) {
  nlopt::opt search(nlopt::LD_LBFGS, static_cast<unsigned>(at.size()));
  std::vector<double> lower, upper;
  for (std::size_t k = 0; k < at.size(); ++k) {
    lower.push_back(posterior.prior.centre[k] - kReach * posterior.prior.spread[k]);
    upper.push_back(posterior.prior.centre[k] + kReach * posterior.prior.spread[k]);
  }
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_min_objective(hyper_objective, &posterior);
  search.set_maxeval(60);
  search.set_ftol_abs(1e-3);
  double value = HUGE_VAL;
  try {
    search.optimize(at, value);
  } catch (const std::runtime_error&) {  // no progress possible any more: `at` is the best so far
    std::vector<double> none;
    value = hyper_objective(at, none, &posterior);
  }
  return value;
}

}  // namespace

MaternKernel fit_kernel(const RegressionData& observations, int restarts, std::uint64_t seed) {
  const Index n = observations.values.size();
  const HyperPrior prior(observations.inputs.cols());
  const double mean = n > 0 ? observations.values.mean() : 0.0;
  const double variance =
      n > 1 ? (observations.values.array() - mean).square().sum() / static_cast<double>(n - 1) : 0.0;
  const double scale = variance > 0.0 ? std::sqrt(variance) : 1.0;
  std::vector<double> best = prior.centre;
  if (n >= 3 && variance > 0.0) {
    RegressionData standard = observations;
    standard.values = (observations.values.array() - mean) / scale;
    standard.noise_variances = observations.noise_variances / variance;
    HyperPosterior posterior{standard, prior};
    double smallest = descend(best, posterior);
    RandomStream random(seed, "optimize/kernel");
    for (int k = 0; k < restarts; ++k) {
      std::vector<double> start = prior.centre;
      for (std::size_t i = 0; i < start.size(); ++i) start[i] += prior.spread[i] * random.uniform(-1.5, 1.5);
      const double value = descend(start, posterior);
      if (value < smallest) smallest = value, best = start;
    }
  }
  MaternKernel kernel = kernel_at(best);
  kernel.signal_deviation *= scale;
  kernel.noise_deviation *= scale;
  return kernel;
}

}  // namespace nacre::optimize
