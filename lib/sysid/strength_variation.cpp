#include "sysid/strength_variation.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"
#include "base/statistics.hpp"
#include "material/failure_criterion.hpp"

namespace nacre::sysid {
namespace {

const double kMiddleVariation = std::sqrt(kSmallVariation * kLargeVariation);
constexpr double kCvFactor = 1.5, kMeasuringFactor = 2.0;  ///< of the priors: standard deviations of the logarithms

/// Variance of log T of specimens with this mean and standard deviation of T.
double log_variance(double mean, double sd) { return std::log1p(square(sd / mean)); }

/// Nodes of the logarithm of an unknown.
std::vector<double> log_nodes(double smallest, double largest) {
  constexpr int kNodes = 81;
  std::vector<double> nodes;
  for (int k = 0; k < kNodes; ++k)
    nodes.push_back(std::log(smallest) + std::log(largest / smallest) * k / (kNodes - 1));
  return nodes;
}

/// Value below which `share` of the weights lie; they sum to 1.
double weighted_quantile(std::span<const double> nodes, std::span<const double> weights, double share) {
  double below = 0.0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    if (below + weights[k] >= share) {
      const double part = weights[k] > 0.0 ? (share - below) / weights[k] : 0.5;
      return nodes[k] + (part - 0.5) * (nodes[k + 1] - nodes[k]);
    }
    below += weights[k];
  }
  return nodes.back();
}

/// The posterior on a grid: weights sum to 1, strength_cv outside, m inside.
struct Posterior {
  std::vector<double> log_cv, log_m, weights;
  double weight(std::size_t i, std::size_t j) const { return weights[i * log_m.size() + j]; }
  std::vector<double> of_cv() const {
    std::vector<double> sums(log_cv.size(), 0.0);
    for (std::size_t i = 0; i < log_cv.size(); ++i)
      for (std::size_t j = 0; j < log_m.size(); ++j) sums[i] += weight(i, j);
    return sums;
  }
  std::vector<double> of_m() const {
    std::vector<double> sums(log_m.size(), 0.0);
    for (std::size_t i = 0; i < log_cv.size(); ++i)
      for (std::size_t j = 0; j < log_m.size(); ++j) sums[j] += weight(i, j);
    return sums;
  }
  double correlation() const {
    double cv = 0.0, m = 0.0, cv_cv = 0.0, m_m = 0.0, cv_m = 0.0;
    for (std::size_t i = 0; i < log_cv.size(); ++i)
      for (std::size_t j = 0; j < log_m.size(); ++j) cv += weight(i, j) * log_cv[i], m += weight(i, j) * log_m[j];
    for (std::size_t i = 0; i < log_cv.size(); ++i)
      for (std::size_t j = 0; j < log_m.size(); ++j) {
        cv_cv += weight(i, j) * square(log_cv[i] - cv);
        m_m += weight(i, j) * square(log_m[j] - m);
        cv_m += weight(i, j) * (log_cv[i] - cv) * (log_m[j] - m);
      }
    return cv_m / std::sqrt(cv_cv * m_m);
  }
};

Posterior posterior_of(std::span<const DesignScatter> designs, const ScatterGrowth& growth, double measuring_sd) {
  constexpr double kFarthest = 4.0;  // of the priors' standard deviations
  const double far = std::pow(kMeasuringFactor, kFarthest);
  Posterior posterior{log_nodes(material::kSmallestStrengthCv, material::kLargestStrengthCv),
                      log_nodes(measuring_sd / far, measuring_sd * far),
                      {}};
  for (const double log_cv : posterior.log_cv) {
    for (const double log_m : posterior.log_m) {
      double log_density = -0.5 * square((log_cv - std::log(material::base_strength_cv())) / std::log(kCvFactor)) -
                           0.5 * square((log_m - std::log(measuring_sd)) / std::log(kMeasuringFactor));
      for (std::size_t d = 0; d < designs.size(); ++d) {
        const double variance = std::exp(2.0 * log_m) + growth.variance(d, std::exp(log_cv));
        log_density -=
            0.5 * designs[d].measured_freedom * (std::log(variance) + designs[d].measured_variance / variance);
      }
      posterior.weights.push_back(log_density);
    }
  }
  const double largest = *std::ranges::max_element(posterior.weights);
  double sum = 0.0;
  for (double& weight : posterior.weights) sum += weight = std::exp(weight - largest);
  for (double& weight : posterior.weights) weight /= sum;
  return posterior;
}

}  // namespace

bool StrengthVariation::determined() const {
  constexpr double kIn90 = 1.645;
  return std::log(high90 / low90) < kIn90 * std::log(kCvFactor);
}

std::vector<DesignScatter> design_scatter(const std::vector<measurement::Replicates>& measured,
                                          const std::vector<Prediction>& small, const std::vector<Prediction>& large) {
  const auto tells = [](const Prediction& each) { return each.specimens > 1 && each.toughness_pa; };
  const auto variance_of = [](const Prediction& each) {
    return log_variance(*each.toughness_pa, each.toughness_sd_pa);
  };
  std::vector<DesignScatter> designs;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const measurement::Replicates& own = measured[i];
    if (own.toughness_count < 2 || own.toughness_pa <= 0.0 || !tells(small[i]) || !tells(large[i])) continue;
    designs.push_back({.measured_variance = log_variance(own.toughness_pa, own.toughness_sd_pa),
                       .measured_freedom = own.toughness_count - 1,
                       .small_variance = variance_of(small[i]),
                       .large_variance = variance_of(large[i]),
                       .small_freedom = small[i].specimens - 1,
                       .large_freedom = large[i].specimens - 1});
  }
  return designs;
}

double expected_measuring_sd(const std::vector<measurement::Replicates>& measured) {
  constexpr double kUnknown = 0.03, kLeast = 0.005;
  double squares = 0.0;
  int freedom = 0;
  for (const measurement::Replicates& each : measured) {
    if (each.modulus_count < 2 || each.modulus_pa <= 0.0) continue;
    squares += (each.modulus_count - 1) * log_variance(each.modulus_pa, each.modulus_sd_pa);
    freedom += each.modulus_count - 1;
  }
  return freedom > 0 ? std::max(kLeast, std::sqrt(2.0 * squares / freedom)) : kUnknown;
}

double ScatterGrowth::variance(std::size_t d, double strength_cv) const {
  return std::pow(strength_cv / kMiddleVariation, 2.0 * exponent) * variances[d];
}

ScatterGrowth scatter_growth(std::span<const DesignScatter> designs) {
  constexpr double kLeast = 1e-12;  // nothing scatters
  double small = kLeast, large = kLeast;
  int small_freedom = 0, large_freedom = 0;
  for (const DesignScatter& d : designs) {
    small += d.small_freedom * d.small_variance, small_freedom += d.small_freedom;
    large += d.large_freedom * d.large_variance, large_freedom += d.large_freedom;
  }
  const double ratio = (large / large_freedom) / (small / small_freedom);
  ScatterGrowth growth{
      .exponent = std::clamp(0.5 * std::log(ratio) / std::log(kLargeVariation / kSmallVariation), 0.0, 1.0),
      .variances = {}};
  const double step = std::pow(kLargeVariation / kMiddleVariation, 2.0 * growth.exponent);
  std::vector<double> own, chance;  // at the middle; variances of these sample variances
  for (const DesignScatter& d : designs) {
    const int freedom = d.small_freedom + d.large_freedom;
    own.push_back((d.small_freedom * d.small_variance * step + d.large_freedom * d.large_variance / step) / freedom);
    chance.push_back(2.0 / freedom);
  }
  const double pooled = mean(own);
  for (double& each : chance) each *= square(pooled);
  const double between = own.size() > 1 ? std::max(0.0, square(standard_deviation(own)) - mean(chance)) : 0.0;
  for (std::size_t d = 0; d < own.size(); ++d) {
    const double share = between + chance[d] > 0.0 ? between / (between + chance[d]) : 0.0;
    growth.variances.push_back(pooled + share * (own[d] - pooled));
  }
  return growth;
}

StrengthVariation fit_strength_variation(std::span<const DesignScatter> designs, double measuring_sd) {
  const ScatterGrowth growth = scatter_growth(designs);
  const Posterior posterior = posterior_of(designs, growth, measuring_sd);
  const std::vector<double> of_cv = posterior.of_cv(), of_m = posterior.of_m();
  const auto cv_at = [&](double share) { return std::exp(weighted_quantile(posterior.log_cv, of_cv, share)); };
  StrengthVariation fitted{.strength_cv = cv_at(0.5),
                           .low90 = cv_at(0.05),
                           .high90 = cv_at(0.95),
                           .measuring_sd = std::exp(weighted_quantile(posterior.log_m, of_m, 0.5)),
                           .correlation = posterior.correlation()};
  double measured = 0.0, predicted = 0.0;
  for (std::size_t d = 0; d < designs.size(); ++d) {
    const int freedom = designs[d].measured_freedom;
    measured += freedom * designs[d].measured_variance;
    predicted += freedom * (square(fitted.measuring_sd) + growth.variance(d, fitted.strength_cv));
    fitted.freedom += freedom;
  }
  fitted.measured_sd = std::sqrt(measured / fitted.freedom);
  fitted.predicted_sd = std::sqrt(predicted / fitted.freedom);
  return fitted;
}

}  // namespace nacre::sysid
