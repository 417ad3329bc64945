#pragma once
// Batch Bayesian optimisation over the unit cube.

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// Batch Bayesian optimisation: a Gaussian process (Matern-5/2, one length scale per dimension, learnt noise besides
/// the known), expected improvement below the smallest posterior mean, batches by local penalisation, Sobol points
/// after the starts. Failed evaluations count as the worst value seen. Throws InputError for settings out of range.
std::unique_ptr<BatchOptimizer> make_bayesian_optimizer(const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
