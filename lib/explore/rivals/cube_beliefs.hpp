#pragma once
// What the rivals' Gaussian processes believe of patterns, in the form that the expected improvement takes.

#include <span>
#include <vector>

#include "explore/improvement.hpp"
#include "explore/rivals/cube_models.hpp"

namespace nacre::explore {

/// Log-normal beliefs with the means and variances of the models' posteriors, without the learnt noise of a test. On
/// patterns the models' covariance is one of weighted numbers of different pixels, so a discrete one. O(n^2) each.
std::vector<Belief> cube_beliefs(const std::vector<ObjectiveModel>& models, std::span<const pattern::Pattern> patterns);

/// Posterior means at evaluated patterns: the points of a front that luck has no part in.
std::vector<optimize::Performance> posterior_points(const std::vector<ObjectiveModel>& models,
                                                    std::span<const Evaluated> evaluated);

/// The patterns of the largest expected improvements over the front of `points`, one by one (best_improvements).
std::vector<pattern::Pattern> best_by_improvement(const std::vector<ObjectiveModel>& models,
                                                  std::span<const Evaluated> candidates,
                                                  const std::vector<optimize::Performance>& points, int count);

}  // namespace nacre::explore
