#pragma once
// Noisy expected hypervolume improvement with a discrete kernel and a local search over flips.

#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// After qLogNEHVI (S. Ament et al., 2023; S. Daulton et al., 2021): the logarithm of the expected hypervolume
/// improvement over the front of posterior means is climbed by flips of single free pixels, from the best evaluated
/// patterns and from random ones; the batch takes the largest improvements met on the way, one by one. Unlike the
/// original, the front is not drawn from its posterior, and the chosen come out at their medians.
std::vector<pattern::Pattern> nehvi_batch(const BatchRequest& batch_request);

}  // namespace nacre::explore
