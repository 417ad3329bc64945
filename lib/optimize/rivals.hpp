#pragma once
// The searches behind make_optimizer() that have no header of their own.

#include <nlopt.hpp>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

std::unique_ptr<BatchOptimizer> make_random_search(const BatchOptimizerSettings& settings);
std::unique_ptr<BatchOptimizer> make_replayed_search(nlopt::algorithm algorithm,
                                                     const BatchOptimizerSettings& settings);

/// Covariance matrix adaptation evolution strategy with the standard strategy parameters (N. Hansen, The CMA Evolution
/// Strategy: A Tutorial, arXiv:1604.00772, Table 1). A generation is handed out in batches; points outside the cube are
/// moved to its face, and the distance that they moved is paid for. When the step has collapsed, the search begins anew
/// with twice the population.
std::unique_ptr<BatchOptimizer> make_cma_es(const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
