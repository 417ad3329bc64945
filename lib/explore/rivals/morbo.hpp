#pragma once
// Multi-objective Bayesian optimisation in trust regions.

#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// A trust region of patterns: all within `radius` flips of its centre.
struct TrustRegion {
  pattern::Pattern centre;
  int radius = 0;
};

/// The trust regions after these samples, told in batches of `batch`. A region's centre is the best by rank of the
/// samples in it. One that adds to the front twice in a row is doubled, one that fails three times in a row is halved,
/// and one that has become too small restarts at the best sample outside of all others. A pure function.
std::vector<TrustRegion> trust_regions(std::span<const Evaluated> samples, int batch);

/// After MORBO (S. Daulton et al., 2022) on the 55 free pixels: models of the samples near each of the trust regions,
/// and the largest expected hypervolume improvements among patterns of all regions.
std::vector<pattern::Pattern> morbo_batch(const BatchRequest& batch_request);

}  // namespace nacre::explore
