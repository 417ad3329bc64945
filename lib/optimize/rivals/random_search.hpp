#pragma once
// Random search over the unit cube: what every other search has to beat.

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// Points uniform in the cube, after the starts. Throws InputError for settings out of range.
std::unique_ptr<BatchOptimizer> make_random_search(const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
