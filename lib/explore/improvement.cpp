#include "explore/improvement.hpp"

#include <algorithm>
#include <cmath>

#include "base/statistics.hpp"

namespace nacre::explore {
namespace {

/// What is left of the errors once the value of one pattern is known.
void learn(Eigen::MatrixXd& covariance, std::size_t known, std::vector<Belief>& beliefs, LogNormal Belief::*property) {
  if (covariance.size() == 0) return;
  const auto i = static_cast<Eigen::Index>(known);
  const double variance = covariance(i, i);
  if (variance <= 0.0) return;
  const Eigen::VectorXd column = covariance.col(i);
  covariance.noalias() -= column * column.transpose() / variance;
  for (std::size_t k = 0; k < beliefs.size(); ++k) {
    const double left = covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
    (beliefs[k].*property).log_deviation = std::sqrt(std::max(0.0, left));
  }
}

}  // namespace

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
  double improvement = 0.0;
  double excess = belief.modulus.expected_excess(0.0);
  for (const optimize::Performance& point : front) {
    const double beyond = belief.modulus.expected_excess(point.modulus_pa);
    improvement += (excess - beyond) * belief.toughness.expected_excess(point.toughness_pa);
    excess = beyond;
  }
  return improvement + excess * belief.toughness.expected_excess(0.0);
}

std::vector<std::size_t> best_improvements(std::vector<Belief> beliefs, std::vector<optimize::Performance> front,
                                           int count, SharedErrors shared) {
  std::vector<std::size_t> chosen;
  std::vector<bool> taken(beliefs.size(), false);
  // What a belief can add only falls as the front grows and as it gets surer: an old value is a bound, and most need no
  // new one.
  std::vector<double> bound(beliefs.size());
  for (std::size_t i = 0; i < beliefs.size(); ++i) bound[i] = expected_improvement(beliefs[i], front);
  std::vector<std::size_t> order(beliefs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  while (chosen.size() < std::min(static_cast<std::size_t>(std::max(0, count)), beliefs.size())) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bound[a] > bound[b]; });
    std::size_t best = beliefs.size();
    for (const std::size_t i : order) {
      if (taken[i]) continue;
      if (best < beliefs.size() && bound[i] <= bound[best]) break;
      if (!chosen.empty()) bound[i] = expected_improvement(beliefs[i], front);
      if (best == beliefs.size() || bound[i] > bound[best]) best = i;
    }
    taken[best] = true;
    chosen.push_back(best);
    front.push_back(beliefs[best].median());
    front = optimize::pareto_front(front);
    learn(shared.log_modulus, best, beliefs, &Belief::modulus);
    learn(shared.log_toughness, best, beliefs, &Belief::toughness);
  }
  return chosen;
}

}  // namespace nacre::explore
