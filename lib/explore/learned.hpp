#pragma once
// The learning-accelerated search (2.3.3, Figure 2-9).

#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// Throws InputError for settings out of range.
void check_learned(const LearnedSettings& settings);

/// The form of 2.3.3: one residual network per property, trained from nothing every time, 200 generations of 100 on
/// them, the first patterns by non-dominated sorting.
LearnedSettings thesis_learning();

/// The next batch. After the random patterns come some with rigid bars. Then predictors of log E and log T are fitted
/// to all samples (and to `former` samples as a first guess), NSGA-II searches on them from the best samples and
/// the best of many random patterns with bars, and among all that are not yet simulated the batch is chosen. Fewer than
/// asked for only when there are fewer.
std::vector<pattern::Pattern> learned_batch(const BatchRequest& batch_request);

}  // namespace nacre::explore
