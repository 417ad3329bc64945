#pragma once
// TSEMO: Thompson sampling for two objectives.

#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// TSEMO (Bradford, Schweidtmann, Lapkin 2018): one function is drawn from the posterior of each objective, NSGA-II
/// finds the front of the drawn functions, and of it the batch is chosen one by one for the largest hypervolume
/// improvement. Open here: posterior draws by pathwise conditioning on spectral features of a Matern-5/2 kernel, and
/// NSGA-II on the patterns themselves with the custom mutation (in its favour: the original moves in a continuous box).
std::vector<pattern::Pattern> tsemo_batch(const BatchRequest& batch_request);

}  // namespace nacre::explore
