#include "explore/improvement.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"
#include "base/statistics.hpp"

namespace nacre::explore {
namespace {

/// What is left of the errors once one pattern is tested with this noise.
void learn(Eigen::MatrixXd& covariance, std::size_t tested, double noise_variance, std::vector<Belief>& beliefs,
           LogNormal Belief::*property) {
  if (covariance.size() == 0) return;
  const auto i = static_cast<Eigen::Index>(tested);
  const double variance = covariance(i, i) + noise_variance;
  if (variance <= 0.0) return;
  const Eigen::VectorXd column = covariance.col(i);
  covariance.noalias() -= column * column.transpose() / variance;
  for (std::size_t k = 0; k < beliefs.size(); ++k) {
    const double left = covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
    (beliefs[k].*property).log_deviation = std::sqrt(std::max(0.0, left));
  }
}

}  // namespace

LogNormal Belief::toughness_ahead() const {
  if (noise_variance <= 0.0) return toughness;
  const double variance = square(toughness.log_deviation), settled = square(variance) / (variance + noise_variance);
  return {toughness.log_mean + 0.5 * (variance - settled), std::sqrt(settled)};
}

double LogNormal::median() const { return std::exp(log_mean); }

double LogNormal::expected_excess(double threshold) const {
  const double variance = log_deviation * log_deviation;
  const double mean = std::exp(log_mean + 0.5 * variance);
  if (threshold <= 0.0) return mean - threshold;
  if (log_deviation <= 0.0) return std::max(0.0, mean - threshold);
  const double reach = (log_mean - std::log(threshold)) / log_deviation;
  return std::max(0.0, mean * normal_cdf(reach + log_deviation) - threshold * normal_cdf(reach));
}

double expected_improvement(const Belief& belief, std::span<const optimize::Performance> front) {
  // Between the moduli of two neighbours the front stands at the toughness of the right one.
  const LogNormal toughness = belief.toughness_ahead();
  double improvement = 0.0;
  double excess = belief.modulus.expected_excess(0.0);
  for (const optimize::Performance& point : front) {
    const double beyond = belief.modulus.expected_excess(point.modulus_pa);
    improvement += (excess - beyond) * toughness.expected_excess(point.toughness_pa);
    excess = beyond;
  }
  return improvement + excess * toughness.expected_excess(0.0);
}

double expected_regrowth(const Belief& belief, std::span<const optimize::Performance> points) {
  std::vector<optimize::Performance> others(points.begin(), points.end());
  if (const auto own = std::ranges::find(others, *belief.present); own != others.end()) others.erase(own);
  const std::vector<optimize::Performance> front = optimize::pareto_front(others);
  const Belief now{{std::log(belief.present->modulus_pa), 0.0}, {std::log(belief.present->toughness_pa), 0.0}};
  return std::max(0.0, expected_improvement(belief, front) - expected_improvement(now, front));
}

std::vector<std::size_t> best_improvements(std::vector<Belief> beliefs, std::vector<optimize::Performance> points,
                                           int count, SharedErrors shared) {
  std::vector<optimize::Performance> front = optimize::pareto_front(points);
  const auto gain = [&](const Belief& belief) {
    return belief.present ? expected_regrowth(belief, points) : expected_improvement(belief, front);
  };
  std::vector<std::size_t> chosen;
  std::vector<bool> taken(beliefs.size(), false);
  // What a new pattern can add only falls as the front grows and as it gets surer: an old value is a bound, and most
  // need no new one. A further specimen of a known one may gain worth when a rival comes: its value is always new.
  std::vector<double> bound(beliefs.size());
  for (std::size_t i = 0; i < beliefs.size(); ++i) bound[i] = gain(beliefs[i]);
  std::vector<std::size_t> order(beliefs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  while (chosen.size() < std::min(static_cast<std::size_t>(std::max(0, count)), beliefs.size())) {
    for (std::size_t i = 0; i < beliefs.size(); ++i)
      if (beliefs[i].present && !chosen.empty()) bound[i] = gain(beliefs[i]);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bound[a] > bound[b]; });
    std::size_t best = beliefs.size();
    for (const std::size_t i : order) {
      if (taken[i]) continue;
      if (best < beliefs.size() && bound[i] <= bound[best]) break;
      if (!chosen.empty() && !beliefs[i].present) bound[i] = gain(beliefs[i]);
      if (best == beliefs.size() || bound[i] > bound[best]) best = i;
    }
    taken[best] = true;
    chosen.push_back(best);
    if (!beliefs[best].present) {
      points.push_back(beliefs[best].median());
      front = optimize::pareto_front(points);
    }
    learn(shared.log_modulus, best, 0.0, beliefs, &Belief::modulus);
    learn(shared.log_toughness, best, beliefs[best].noise_variance, beliefs, &Belief::toughness);
  }
  return chosen;
}

}  // namespace nacre::explore
