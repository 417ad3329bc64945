#include "explore/rivals/cube_beliefs.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"

namespace nacre::explore {
namespace {

/// With a mean and a deviation, in Pa; a mean that is not positive counts as next to nothing.
LogNormal log_normal(double mean_pa, double deviation_pa) {
  constexpr double kLeastPa = 1.0;
  const double mean = std::max(mean_pa, kLeastPa);
  const double variance = std::log1p(square(deviation_pa / mean));
  return {std::log(mean) - 0.5 * variance, std::sqrt(variance)};
}

}  // namespace

std::vector<Belief> cube_beliefs(const std::vector<ObjectiveModel>& models,
                                 std::span<const pattern::Pattern> patterns) {
  std::vector<Belief> beliefs(patterns.size());
  const Eigen::MatrixXd at = points_of(patterns);
  for (const auto& [model, property] :
       {std::pair{&models[0], &Belief::modulus}, std::pair{&models[1], &Belief::toughness}}) {
    const auto posterior = model->process.predict_all(at);
    for (std::size_t i = 0; i < patterns.size(); ++i)
      beliefs[i].*property =
          log_normal(model->mean + model->deviation * posterior[i].mean, model->deviation * posterior[i].deviation);
  }
  return beliefs;
}

std::vector<optimize::Performance> posterior_points(const std::vector<ObjectiveModel>& models,
                                                    std::span<const Evaluated> evaluated) {
  std::vector<pattern::Pattern> patterns;
  for (const Evaluated& sample : evaluated) patterns.push_back(sample.pattern);
  const Eigen::MatrixXd at = points_of(patterns);
  const Eigen::VectorXd modulus = models[0].process.means(at), toughness = models[1].process.means(at);
  std::vector<optimize::Performance> points;
  for (Eigen::Index i = 0; i < modulus.size(); ++i)
    points.push_back({std::max(0.0, models[0].mean + models[0].deviation * modulus[i]),
                      std::max(0.0, models[1].mean + models[1].deviation * toughness[i])});
  return points;
}

std::vector<pattern::Pattern> best_by_improvement(const std::vector<ObjectiveModel>& models,
                                                  std::span<const Evaluated> candidates,
                                                  const std::vector<optimize::Performance>& points, int count) {
  std::vector<pattern::Pattern> patterns, best;
  for (const Evaluated& candidate : candidates) patterns.push_back(candidate.pattern);
  if (patterns.empty()) return best;
  for (const std::size_t i : best_improvements(cube_beliefs(models, patterns), points, count))
    best.push_back(patterns[i]);
  return best;
}

}  // namespace nacre::explore
