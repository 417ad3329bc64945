#pragma once
// Global algorithms of NLopt (DIRECT-L, controlled random search), asked in batches.

#include <nlopt.hpp>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// One run of a global algorithm, replayed on recorded values (optimize/replay.hpp) until it wants an unknown point.
/// Throws InputError for settings out of range.
std::unique_ptr<BatchOptimizer> make_replayed_search(nlopt::algorithm algorithm,
                                                     const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
