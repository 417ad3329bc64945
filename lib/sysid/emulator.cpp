#include "sysid/emulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlopt.hpp>
#include <numeric>

#include "base/matern.hpp"
#include "base/square.hpp"
#include "sysid/shared_errors.hpp"
#include "sysid/spread.hpp"

namespace nacre::sysid {
namespace {

constexpr std::size_t kMostInputs = 60;
// Prior mean of the sensitivities d log T / d log p and d log peak / d log p, by the scaling laws: the sums over the
// moduli are 0 and 1/2, over the failure energies 1 and 1/2. The split favours the materials that carry the load.
constexpr std::array<double, kEtaCount> kToughnessSlope = {0, 0, 0, 0, 0, 0, 0.2, 0.4, 0.4, 0};
constexpr std::array<double, kEtaCount> kPeakSlope = {0.05, 0.25, 0.2, 0, 0, 0, 0.1, 0.2, 0.2, 0};
constexpr double kOffsetDeviation = 2.0;   // of a feature's level
constexpr double kGammaDeviation = 0.15;   // of the sensitivity to log gamma
constexpr double kPoissonDeviation = 0.2;  // over the whole range of a Poisson's ratio

constexpr double kSmallestNoise = 0.03;  // of a residual, when deviations are computed

/// Covariance of the linear part over one group of three materials: sensitivities s = mean + split with sum zero +
/// common.
double group_covariance(const EmulatorPrior& prior, const double* a, const double* b) {
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const double sums = (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2]);
  return square(prior.split_deviation) * (dot - sums / 3.0) + square(prior.sum_deviation) * sums / 9.0;
}

/// Distance over which what is not linear changes. The common scales of moduli and of failure energies hardly count:
/// dimensions fix what they do, but for inertia, damping and large strains.
double curved_distance(Eigen::VectorXd difference) {
  constexpr double kScaleShare = 0.2;
  for (const int first : {kE0, kW0}) {
    auto group = difference.segment<3>(first);
    group.array() -= (1.0 - kScaleShare) * group.mean();
  }
  return difference.norm();
}

double prior_mean(const std::array<double, kEtaCount>& slope, const Eigen::VectorXd& at) {
  double sum = 0.0;
  for (int j = 0; j < kEtaCount; ++j) sum += slope[j] * at[j];
  return sum;
}

/// Indices of the trials nearest to trials[centre], itself first.
std::vector<std::size_t> nearest_trials(const std::vector<FitTrial>& trials, std::size_t centre) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < trials.size(); ++k) {
    order.emplace_back(pull_to_start(trials[k].point, trials[centre].point, 1.0), k);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> result;
  for (const auto& entry : order) {
    if (result.size() < kMostInputs) result.push_back(entry.second);
  }
  return result;
}

}  // namespace

std::vector<double> spans_of(std::span<const material::ParameterRange> ranges) {
  std::vector<double> spans;
  for (const material::ParameterRange& range : ranges) {
    spans.push_back(range.logarithmic() ? std::log(range.maximum / range.minimum) : 1.0);
  }
  return spans;
}

FeatureEmulator::FeatureEmulator(std::vector<double> spans, std::size_t design_count)
    : spans_(std::move(spans)), design_count_(design_count) {}

Eigen::VectorXd FeatureEmulator::coordinates(const Point& point) const {
  Eigen::VectorXd result(kEtaCount);
  for (int j = 0; j < kEtaCount; ++j) {
    result[j] = point[j] * spans_[j];
  }
  return result;
}

double FeatureEmulator::covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  // Seen from the centre, so that the linear part does not depend on where the ranges begin.
  const Eigen::VectorXd from_a = a - centre_, from_b = b - centre_;
  const double linear = group_covariance(prior_, from_a.data() + kE0, from_b.data() + kE0) +
                        group_covariance(prior_, from_a.data() + kW0, from_b.data() + kW0) +
                        square(kPoissonDeviation) * from_a.segment<3>(kNu0).dot(from_b.segment<3>(kNu0)) +
                        square(kGammaDeviation) * from_a[kGamma] * from_b[kGamma];
  const double distance = curved_distance(a - b) / prior_.curved_length;
  return square(kOffsetDeviation) + linear + square(prior_.curved_deviation) * matern52(std::sqrt(5.0) * distance);
}

Eigen::VectorXd FeatureEmulator::covariances(const Eigen::VectorXd& at) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(inputs_.size()));
  for (std::size_t k = 0; k < inputs_.size(); ++k) result[k] = covariance(at, inputs_[k]);
  return result;
}

void FeatureEmulator::factorise() {
  const Eigen::Index count = inputs_.size();
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      matrix(i, j) = matrix(j, i) = covariance(inputs_[i], inputs_[j]);
    }
    matrix(i, i) += square(prior_.noise_deviation);
  }
  factor_.compute(matrix);
}

void FeatureEmulator::learn(const std::vector<FitTrial>& trials, std::size_t centre) {
  prior_ = {};
  take_targets(trials, centre);
  solve();
}

void FeatureEmulator::take_targets(const std::vector<FitTrial>& trials, std::size_t centre) {
  used_ = nearest_trials(trials, centre);
  centre_ = coordinates(trials[centre].point);
  inputs_.clear();
  for (const std::size_t k : used_) inputs_.push_back(coordinates(trials[k].point));
  const Eigen::Index rows = used_.size();
  targets_ = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(2 * design_count_));
  for (std::size_t i = 0; i < design_count_; ++i) {
    const Eigen::Index column = 2 * i;
    const std::optional<CurveFeatures> base = features_of(trials[centre].predictions[i]);
    for (Eigen::Index row = 0; base && row < rows; ++row) {
      const auto here = features_of(trials[used_[row]].predictions[i]);
      if (!here) continue;  // zero: what the prior expects
      const Eigen::VectorXd moved = inputs_[row] - centre_;
      targets_(row, column) = here->log_toughness - base->log_toughness - prior_mean(kToughnessSlope, moved);
      targets_(row, column + 1) = here->log_peak - base->log_peak - prior_mean(kPeakSlope, moved);
    }
  }
}

void FeatureEmulator::solve() {
  factorise();
  coefficients_ = factor_.solve(targets_);
  at_centre_ = covariances(centre_).transpose() * coefficients_;
}

/// Log density of all targets under the prior, which all designs and both features share.
double FeatureEmulator::log_evidence() const {
  const Eigen::MatrixXd lower = factor_.matrixL();
  return -0.5 * targets_.cwiseProduct(coefficients_).sum() -
         static_cast<double>(targets_.cols()) * lower.diagonal().array().log().sum();
}

void FeatureEmulator::learn_with_prior(const std::vector<FitTrial>& trials, std::size_t centre) {
  constexpr double kReach = 2.0;
  constexpr double kSpread = 0.7;   // of the logarithms of the prior's figures around their defaults
  constexpr int kEvaluations = 60;  // it goes on from the last fit
  constexpr std::size_t kFewestTrials = 5;
  take_targets(trials, centre);
  if (used_.size() < kFewestTrials) return solve();
  const auto prior_at = [](const std::vector<double>& log_factors) {
    EmulatorPrior prior;
    prior.split_deviation *= std::exp(log_factors[0]);
    prior.sum_deviation *= std::exp(log_factors[1]);
    prior.curved_deviation *= std::exp(log_factors[2]);
    prior.curved_length *= std::exp(log_factors[3]);
    prior.noise_deviation *= std::exp(log_factors[4]);
    return prior;
  };
  struct Posterior {
    FeatureEmulator& emulator;
    decltype(prior_at)& prior;
  } posterior{*this, prior_at};
  const auto cost = [](const std::vector<double>& at, std::vector<double>&, void* data) {
    const Posterior& own = *static_cast<Posterior*>(data);
    own.emulator.prior_ = own.prior(at);
    own.emulator.solve();
    double sum = 0.0;
    for (const double value : at) sum += 0.5 * square(value / kSpread);
    return sum - own.emulator.log_evidence();
  };
  const EmulatorPrior first;
  std::vector<double> at = {
      std::log(prior_.split_deviation / first.split_deviation), std::log(prior_.sum_deviation / first.sum_deviation),
      std::log(prior_.curved_deviation / first.curved_deviation), std::log(prior_.curved_length / first.curved_length),
      std::log(prior_.noise_deviation / first.noise_deviation)};
  for (double& value : at) value = std::clamp(value, -kReach, kReach);
  nlopt::opt search(nlopt::LN_SBPLX, 5);
  search.set_lower_bounds(-kReach);
  search.set_upper_bounds(kReach);
  search.set_initial_step(0.3);
  search.set_maxeval(kEvaluations);
  search.set_min_objective(cost, &posterior);
  try {
    double smallest = 0.0;
    search.optimize(at, smallest);
  } catch (const nlopt::roundoff_limited&) {  // the point reached is the best that doubles can tell
  }
  prior_ = prior_at(at);
  solve();
}

void FeatureEmulator::change(const Eigen::VectorXd& at, const Eigen::VectorXd& to_inputs,
                             const Eigen::RowVectorXd& offset, std::vector<FeatureChange>& changes) const {
  const Eigen::RowVectorXd learnt = to_inputs.head(coefficients_.rows()).transpose() * coefficients_ - offset;
  const double toughness = prior_mean(kToughnessSlope, at - centre_), peak = prior_mean(kPeakSlope, at - centre_);
  changes.resize(design_count_);
  for (std::size_t i = 0; i < design_count_; ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(2 * i);
    changes[i] = {toughness + learnt[column], peak + learnt[column + 1]};
  }
}

void FeatureEmulator::predict(const Point& point, std::vector<FeatureChange>& changes) const {
  const Eigen::VectorXd at = coordinates(point);
  change(at, covariances(at), at_centre_, changes);
}

void FeatureEmulator::predict_smooth(const Point& point, std::vector<FeatureChange>& changes) const {
  const Eigen::VectorXd at = coordinates(point);
  change(at, covariances(at), Eigen::RowVectorXd::Zero(at_centre_.size()), changes);
}

double FeatureEmulator::predict_with_deviation(const Point& point, std::vector<FeatureChange>& changes) const {
  const Eigen::VectorXd at = coordinates(point), to_inputs = covariances(at);
  change(at, to_inputs, Eigen::RowVectorXd::Zero(at_centre_.size()), changes);
  return std::sqrt(std::max(0.0, covariance(at, at) - factor_.matrixL().solve(to_inputs).squaredNorm()));
}

double FeatureEmulator::deviation(const Point& point) const {
  const Eigen::VectorXd at = coordinates(point);
  const Eigen::VectorXd difference = covariances(at) - covariances(centre_);
  const double prior = covariance(at, at) - 2.0 * covariance(at, centre_) + covariance(centre_, centre_);
  return std::sqrt(std::max(0.0, prior - difference.dot(factor_.solve(difference))));
}

Eigen::MatrixXd feature_slopes(const FeatureEmulator& emulator, const Point& at, std::size_t design_count,
                               bool poisson_searched) {
  constexpr double kStep = 0.05;
  const Eigen::Index designs = design_count;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2 * designs, kEtaCount);
  std::vector<FeatureChange> up, down;
  for (int j = 0; j < kEtaCount; ++j) {
    const bool is_poisson = j >= kNu0 && j < kW0;
    if (is_poisson && !poisson_searched) continue;
    Point moved = at;
    moved[j] += kStep;
    emulator.predict(moved, up);
    moved[j] -= 2 * kStep;
    emulator.predict(moved, down);
    for (Eigen::Index i = 0; i < designs; ++i) {
      const std::size_t index = i;
      slopes(i, j) = (up[index].log_toughness - down[index].log_toughness) / (2 * kStep);
      slopes(designs + i, j) = (up[index].log_peak - down[index].log_peak) / (2 * kStep);
    }
  }
  return slopes;
}

ToughnessModel toughness_model(const FitData& data, const std::vector<FitTrial>& trials, std::size_t best,
                               const std::vector<double>& spans, bool poisson_searched) {
  ToughnessModel model{
      .searched = {kSearchedEta.begin(), kSearchedEta.end()}, .slopes = {}, .residuals = {}, .weights = {}};
  if (poisson_searched) {
    model.searched.resize(kEtaCount);
    std::iota(model.searched.begin(), model.searched.end(), 0);
  }
  FeatureEmulator emulator(spans, data.measured.size());
  emulator.learn(trials, best);
  model.slopes =
      feature_slopes(emulator, trials[best].point, data.measured.size(), poisson_searched)(Eigen::all, model.searched);
  const Eigen::Index designs = data.measured.size();
  model.residuals = model.weights = Eigen::VectorXd::Zero(2 * designs);
  for (Eigen::Index i = 0; i < designs; ++i) {
    const measurement::Replicates& measured = data.measured[i];
    const auto simulated = features_of(trials[best].predictions[i]);
    if (!simulated) continue;  // weight 0
    model.residuals[i] = simulated->log_toughness - std::log(measured.toughness_pa);
    model.weights[i] = data.weights[i];
    const std::optional<double> peak = peak_of(measured);
    if (!peak) continue;
    model.residuals[designs + i] = simulated->log_peak - std::log(*peak);
    model.weights[designs + i] = model.weights[i];
  }
  model.noise = noise_variance(model.slopes, model.residuals, model.weights, kSmallestNoise);
  return model;
}

std::vector<double> toughness_deviations(const FitData& data, const std::vector<FitTrial>& trials, std::size_t best,
                                         const std::vector<double>& spans, bool poisson_searched,
                                         const DiscretisationFloor& floor) {
  std::vector<double> deviations(kEtaCount, kUnknownDeviation);
  if (trials.size() < 2) return deviations;
  const ToughnessModel model = toughness_model(data, trials, best, spans, poisson_searched);
  const std::vector<double> searched = parameter_deviations(
      model.slopes, model.residuals, model.weights, kSmallestNoise, shared_fracture_errors(data.measured, floor));
  for (std::size_t k = 0; k < model.searched.size(); ++k) deviations[model.searched[k]] = searched[k];
  return deviations;
}

void FeatureEmulator::add_pending(const Point& point) {
  inputs_.push_back(coordinates(point));
  factorise();
}

}  // namespace nacre::sysid
