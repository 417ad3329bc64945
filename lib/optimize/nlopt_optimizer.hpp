#pragma once
// The trust region: local searches of NLopt, asked in batches.

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// Local searches of NLopt (BOBYQA and Nelder-Mead in turn): first the starts, then a search from the best of them; one
/// that ends or finds nothing new gives way to the next, from the best point so far with half the step. NLopt calls
/// back instead of being asked, so each ask() runs the search anew on the values recorded so far until it wants an
/// unknown point; the rest of the batch are the points that it would want next if that point were as good as its
/// nearest neighbour. The whole budget is used and no point is asked for twice. Failed evaluations count, and are worse
/// to the search than all others known at that time. Throws InputError for settings out of range.
std::unique_ptr<BatchOptimizer> make_nlopt_optimizer(const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
