#pragma once
// The surrogate of the rivals from Bayesian optimisation: a Gaussian process per objective over the free pixels as
// coordinates, with one length scale for each.

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "explore/search.hpp"
#include "optimize/gaussian_process.hpp"

namespace nacre::explore {

/// A pattern as a point: one coordinate per free pixel, soft at 0, rigid at an edge whose length makes two random
/// patterns lie about 1 apart, so that the process' prior over length scales fits.
Eigen::VectorXd point_of(const pattern::Pattern& pattern);
Eigen::MatrixXd points_of(std::span<const pattern::Pattern> patterns);
/// Coordinate of a rigid pixel.
double rigid_coordinate();

/// Posterior of one objective, standardised (mean 0, deviation 1), the larger the better.
struct ObjectiveModel {
  double mean = 0.0, deviation = 1.0;  ///< of the objective in Pa: value = mean + deviation * standardised
  optimize::GaussianProcess process;
};

/// Modulus and toughness. Kernels are decided on at most `kCubeKernelSamples` samples chosen by the seed.
std::vector<ObjectiveModel> fit_cube_models(std::span<const Evaluated> samples, std::uint64_t seed);
inline constexpr int kCubeKernelSamples = 200;

/// The feasible pattern next to a point: rounded, then repaired by the rules of the mutation operator.
pattern::Pattern nearest_pattern(const Eigen::VectorXd& point, RandomStream& random);

}  // namespace nacre::explore
