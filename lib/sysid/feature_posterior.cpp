#include "sysid/feature_posterior.hpp"

#include <cmath>
#include <limits>

#include "base/square.hpp"
#include "sysid/shared_errors.hpp"
#include "sysid/spread.hpp"

namespace nacre::sysid {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kPriorFreedom = 6.0;  // as many designs' worth of belief in scatter and floor

}  // namespace

FeaturePosterior::FeaturePosterior(const FitData& data, Point start, const DiscretisationFloor& floor)
    : start_(std::move(start)), shared_errors_(shared_fracture_errors(data.measured, floor)) {
  const RelativeScatter scatter = pooled_relative_scatter(data.measured);
  for (const measurement::Replicates& design : data.measured) {
    const std::optional<double> peak = peak_of(design);
    toughness_.measured.push_back(std::log(design.toughness_pa));
    toughness_.variances.push_back(toughness_variance(design, scatter, floor));
    peak_.measured.push_back(peak ? std::log(*peak) : kNone);
    peak_.variances.push_back(peak_variance(scatter, floor));
  }
  evidence_ = data.evidence;
  evidence_.resize(data.measured.size(), 1.0);
  toughness_.base.assign(data.measured.size(), kNone);
  peak_.base = toughness_.base;
}

void FeaturePosterior::set_base(const FitTrial& trial) {
  for (std::size_t i = 0; i < toughness_.base.size(); ++i) {
    const auto features = features_of(trial.predictions[i]);
    toughness_.base[i] = features ? features->log_toughness : kNone;
    peak_.base[i] = features ? features->log_peak : kNone;
  }
}

double FeaturePosterior::learnt_factor(const Feature& feature) const {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < feature.measured.size(); ++i) {
    const double residual = feature.base[i] - feature.measured[i];
    if (std::isnan(residual)) continue;
    sum += evidence_[i] * square(residual) / feature.variances[i];
    count += evidence_[i];
  }
  return (kPriorFreedom + sum) / (kPriorFreedom + count);
}

double FeaturePosterior::operator()(const Point& point, std::span<const FeatureChange> changes) const {
  return (*this)(point, changes, 0.0, Eigen::VectorXd());
}

double FeaturePosterior::operator()(const Point& point, std::span<const FeatureChange> changes, double deviation,
                                    const Eigen::VectorXd& shared) const {
  const Eigen::Index designs = toughness_.measured.size();
  Eigen::VectorXd offsets = Eigen::VectorXd::Zero(2 * designs);
  if (shared.size() > 0) offsets = shared_errors_ * shared;
  double cost = 0.5 * shared.squaredNorm();
  const auto add = [&](const Feature& feature, double FeatureChange::*change, Eigen::Index first) {
    double sum = 0.0, count = 0.0;
    for (Eigen::Index i = 0; i < designs; ++i) {
      const std::size_t index = i;
      const double residual =
          feature.base[index] + changes[index].*change - offsets[first + i] - feature.measured[index];
      if (std::isnan(residual)) continue;
      const double variance = feature.variances[index] + square(deviation);
      sum += evidence_[index] * square(residual) / variance;
      if (deviation > 0.0) cost += 0.5 * evidence_[index] * std::log(variance / feature.variances[index]);
      count += evidence_[index];
    }
    cost += 0.5 * (count + kPriorFreedom) * std::log(kPriorFreedom + sum);
  };
  add(toughness_, &FeatureChange::log_toughness, 0);
  add(peak_, &FeatureChange::log_peak, designs);
  for (std::size_t j = 0; j < point.size(); ++j) cost += 0.5 * square((point[j] - start_[j]) / kUnknownDeviation);
  return cost;
}

Eigen::VectorXd FeaturePosterior::learnt_precisions() const {
  const Eigen::Index designs = static_cast<Eigen::Index>(toughness_.measured.size());
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(2 * designs, std::numeric_limits<double>::infinity());
  const auto fill = [&](const Feature& feature, Eigen::Index first) {
    const double factor = learnt_factor(feature);
    for (Eigen::Index i = 0; i < designs; ++i) {
      const std::size_t index = static_cast<std::size_t>(i);
      if (!std::isnan(feature.base[index] - feature.measured[index]))
        variances[first + i] = factor * feature.variances[index] / evidence_[index];
    }
  };
  fill(toughness_, 0);
  fill(peak_, designs);
  return variances.cwiseInverse();
}

Eigen::MatrixXd FeaturePosterior::information(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& precisions) const {
  Eigen::MatrixXd result = slopes.transpose() * precisions.asDiagonal() * slopes;
  result.diagonal().array() += kUnknownPrecision;
  return result;
}

Eigen::MatrixXd FeaturePosterior::posterior_covariance(const Eigen::MatrixXd& slopes) const {
  const Eigen::MatrixXd precision = information(slopes, learnt_precisions());
  return precision.llt().solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
}

Eigen::MatrixXd FeaturePosterior::moves_by_shared_errors(const Eigen::MatrixXd& slopes) const {
  return posterior_covariance(slopes) * slopes.transpose() * learnt_precisions().asDiagonal() * shared_errors_;
}

}  // namespace nacre::sysid
