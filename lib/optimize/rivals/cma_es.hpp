#pragma once
// CMA-ES over the unit cube.

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// Covariance matrix adaptation evolution strategy with the standard strategy parameters (N. Hansen, The CMA Evolution
/// Strategy: A Tutorial, arXiv:1604.00772, Table 1). A generation is handed out in batches; points outside the cube are
/// moved to its face, and the distance that they moved is paid for. When the step has collapsed, the search restarts
/// with twice the population. Throws InputError for settings out of range.
std::unique_ptr<BatchOptimizer> make_cma_es(const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
