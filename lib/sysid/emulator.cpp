#include "sysid/emulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sysid/spread.hpp"

namespace nacre::sysid {
namespace {

constexpr std::size_t kMostInputs = 60;
// Prior mean of the sensitivities d log T / d log p and d log peak / d log p, by the scaling laws: the sums over the
// moduli are 0 and 1/2, over the failure energies 1 and 1/2. The split favours the materials that carry the load.
constexpr std::array<double, kEtaCount> kToughnessSlope = {0, 0, 0, 0, 0, 0, 0.2, 0.4, 0.4, 0};
constexpr std::array<double, kEtaCount> kPeakSlope = {0.05, 0.25, 0.2, 0, 0, 0, 0.1, 0.2, 0.2, 0};
constexpr double kOffsetDeviation = 2.0;   // of a feature's level
constexpr double kSplitDeviation = 0.3;    // of how a sum of sensitivities splits over the materials
constexpr double kSumDeviation = 0.1;      // of the sum itself: inertia, damping and large strains
constexpr double kGammaDeviation = 0.15;   // of the sensitivity to log gamma
constexpr double kPoissonDeviation = 0.2;  // over the whole range of a Poisson's ratio
constexpr double kCurvedDeviation = 0.2;   // of what is not linear
constexpr double kCurvedLength = 1.5;      // in natural logarithms
constexpr double kNoiseDeviation = 0.05;   // elements fail one by one: T jumps by some percent

double square(double x) { return x * x; }

/// Covariance of the linear part over one group of three materials: sensitivities s = mean + split with sum zero +
/// common.
double group_covariance(const double* a, const double* b) {
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const double sums = (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2]);
  return square(kSplitDeviation) * (dot - sums / 3.0) + square(kSumDeviation) * sums / 9.0;
}

double matern52(double distance) {
  const double r = std::sqrt(5.0) * distance;
  return (1.0 + r + r * r / 3.0) * std::exp(-r);
}

double prior_mean(const std::array<double, kEtaCount>& slope, const Eigen::VectorXd& at) {
  double sum = 0.0;
  for (int j = 0; j < kEtaCount; ++j) sum += slope[static_cast<std::size_t>(j)] * at[j];
  return sum;
}

std::optional<FeatureChange> features_of(const Prediction& prediction) {
  if (!prediction.toughness_pa || *prediction.toughness_pa <= 0.0) return std::nullopt;
  const double log_toughness = std::log(*prediction.toughness_pa);
  const auto& stress = prediction.curve.stress_pa;
  const double peak = stress.empty() ? 0.0 : *std::max_element(stress.begin(), stress.end());
  return FeatureChange{log_toughness, peak > 0.0 ? std::log(peak) : 0.5 * log_toughness};
}

/// Indices of the trials nearest to trials[centre], itself first.
std::vector<std::size_t> nearest_trials(const std::vector<Trial>& trials, std::size_t centre) {
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
    result[j] = point[static_cast<std::size_t>(j)] * spans_[static_cast<std::size_t>(j)];
  }
  return result;
}

double FeatureEmulator::covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  // Seen from the centre, so that the linear part does not depend on where the ranges begin.
  const Eigen::VectorXd from_a = a - centre_, from_b = b - centre_;
  const double linear = group_covariance(from_a.data() + kE0, from_b.data() + kE0) +
                        group_covariance(from_a.data() + kW0, from_b.data() + kW0) +
                        square(kPoissonDeviation) * from_a.segment<3>(kNu0).dot(from_b.segment<3>(kNu0)) +
                        square(kGammaDeviation) * from_a[kGamma] * from_b[kGamma];
  const double distance = (a - b).norm() / kCurvedLength;
  return square(kOffsetDeviation) + linear + square(kCurvedDeviation) * matern52(distance);
}

Eigen::VectorXd FeatureEmulator::covariances(const Eigen::VectorXd& at) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(inputs_.size()));
  for (std::size_t k = 0; k < inputs_.size(); ++k) result[static_cast<Eigen::Index>(k)] = covariance(at, inputs_[k]);
  return result;
}

void FeatureEmulator::factorise() {
  const Eigen::Index count = static_cast<Eigen::Index>(inputs_.size());
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      matrix(i, j) = matrix(j, i) =
          covariance(inputs_[static_cast<std::size_t>(i)], inputs_[static_cast<std::size_t>(j)]);
    }
    matrix(i, i) += square(kNoiseDeviation);
  }
  factor_.compute(matrix);
}

void FeatureEmulator::learn(const std::vector<Trial>& trials, std::size_t centre) {
  const std::vector<std::size_t> used = nearest_trials(trials, centre);
  centre_ = coordinates(trials[centre].point);
  inputs_.clear();
  for (const std::size_t k : used) inputs_.push_back(coordinates(trials[k].point));
  factorise();
  const Eigen::Index rows = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd targets = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(2 * design_count_));
  for (std::size_t i = 0; i < design_count_; ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(2 * i);
    const std::optional<FeatureChange> base = features_of(trials[centre].predictions[i]);
    for (Eigen::Index row = 0; base && row < rows; ++row) {
      const std::optional<FeatureChange> here = features_of(trials[used[static_cast<std::size_t>(row)]].predictions[i]);
      if (!here) continue;  // zero: what the prior expects
      const Eigen::VectorXd moved = inputs_[static_cast<std::size_t>(row)] - centre_;
      targets(row, column) = here->log_toughness - base->log_toughness - prior_mean(kToughnessSlope, moved);
      targets(row, column + 1) = here->log_peak - base->log_peak - prior_mean(kPeakSlope, moved);
    }
  }
  coefficients_ = factor_.solve(targets);
  at_centre_ = covariances(centre_).transpose() * coefficients_;
}

void FeatureEmulator::predict(const Point& point, std::vector<FeatureChange>& changes) const {
  const Eigen::VectorXd at = coordinates(point);
  const Eigen::VectorXd weights = covariances(at).head(coefficients_.rows());
  const Eigen::RowVectorXd learnt = weights.transpose() * coefficients_ - at_centre_;
  const double toughness = prior_mean(kToughnessSlope, at - centre_), peak = prior_mean(kPeakSlope, at - centre_);
  changes.resize(design_count_);
  for (std::size_t i = 0; i < design_count_; ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(2 * i);
    changes[i] = {toughness + learnt[column], peak + learnt[column + 1]};
  }
}

double FeatureEmulator::deviation(const Point& point) const {
  const Eigen::VectorXd at = coordinates(point);
  const Eigen::VectorXd difference = covariances(at) - covariances(centre_);
  const double prior = covariance(at, at) - 2.0 * covariance(at, centre_) + covariance(centre_, centre_);
  return std::sqrt(std::max(0.0, prior - difference.dot(factor_.solve(difference))));
}

std::vector<double> toughness_deviations(const FitData& data, const std::vector<Trial>& trials, std::size_t best,
                                         const std::vector<double>& spans, bool poisson_searched) {
  constexpr double kStep = 0.05, kSmallestNoise = 0.03;
  std::vector<double> unknown(kEtaCount, kUnknownDeviation);
  if (trials.size() < 2) return unknown;
  FeatureEmulator emulator(spans, data.measured.size());
  emulator.learn(trials, best);
  const Eigen::Index designs = static_cast<Eigen::Index>(data.measured.size());
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2 * designs, kEtaCount);
  Eigen::VectorXd residuals = Eigen::VectorXd::Zero(2 * designs), weights = residuals;
  std::vector<FeatureChange> changes;
  for (int j = 0; j < kEtaCount; ++j) {
    const bool is_poisson = j >= kNu0 && j < kW0;
    if (is_poisson && !poisson_searched) continue;
    Point moved = trials[best].point;
    moved[static_cast<std::size_t>(j)] += kStep;
    emulator.predict(moved, changes);
    for (Eigen::Index i = 0; i < designs; ++i) {
      jacobian(i, j) = changes[static_cast<std::size_t>(i)].log_toughness / kStep;
      jacobian(designs + i, j) = changes[static_cast<std::size_t>(i)].log_peak / kStep;
    }
  }
  for (Eigen::Index i = 0; i < designs; ++i) {
    const measurement::Replicates& measured = data.measured[static_cast<std::size_t>(i)];
    const std::optional<FeatureChange> simulated = features_of(trials[best].predictions[static_cast<std::size_t>(i)]);
    if (!simulated) continue;  // weight 0
    residuals[i] = simulated->log_toughness - std::log(measured.toughness_pa);
    weights[i] = data.weights[static_cast<std::size_t>(i)];
    const auto& stress = measured.representative_curve.stress_pa;
    const double peak = stress.empty() ? 0.0 : *std::max_element(stress.begin(), stress.end());
    if (peak <= 0.0) continue;
    residuals[designs + i] = simulated->log_peak - std::log(peak);
    weights[designs + i] = weights[i];
  }
  if (weights.sum() <= 0.0) return unknown;
  return parameter_deviations(jacobian, residuals, weights, kSmallestNoise);
}

void FeatureEmulator::add_pending(const Point& point) {
  inputs_.push_back(coordinates(point));
  factorise();
}

}  // namespace nacre::sysid
