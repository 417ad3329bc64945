#pragma once
// Evolution-guided Bayesian optimisation.

#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// After EGBO (A. K. Y. Low et al., 2024): NSGA-II on the evaluated population proposes offspring, and those with the
/// largest noisy expected hypervolume improvement are simulated.
std::vector<pattern::Pattern> egbo_batch(const BatchRequest& batch_request);

}  // namespace nacre::explore
