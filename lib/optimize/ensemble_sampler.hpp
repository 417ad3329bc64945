#pragma once
// Markov-chain Monte Carlo: the affine-invariant ensemble sampler.

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "base/random.hpp"

namespace nacre::optimize {

/// Draws from a distribution whose density is known up to a factor: the affine-invariant ensemble sampler with stretch
/// moves (J. Goodman and J. Weare, Comm. App. Math. Comp. Sci. 5, 65 (2010)). No step size to choose, and a long narrow
/// density is as easy as a round one.
///
/// `cost` is -log density; infinite where it is zero. `walkers`: at least twice as many as dimensions, an even number,
/// each of finite cost, not all on one plane; they are moved `burn_in` times and then `steps` times more. Returns the
/// walkers of these last steps, one after the other. Deterministic in the stream.
std::vector<Eigen::VectorXd> sample_ensemble(const std::function<double(const Eigen::VectorXd&)>& cost,
                                             std::vector<Eigen::VectorXd> walkers, int burn_in, int steps,
                                             RandomStream random);

}  // namespace nacre::optimize
