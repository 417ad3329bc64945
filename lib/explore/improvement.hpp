#pragma once
// Expected hypervolume improvement in closed form: E[growth] = sum over the steps of the front of the product of two
// expected excesses.

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "optimize/pareto.hpp"

namespace nacre::explore {

/// Belief about a positive quantity: its natural logarithm is normal.
struct LogNormal {
  double log_mean = 0.0;
  double log_deviation = 0.0;  ///< 0: certain
  /// E[max(0, y - threshold)], threshold >= 0.
  double expected_excess(double threshold) const;
  double median() const;
};

/// Beliefs about modulus (Pa) and toughness (Pa) of one pattern, independent of each other.
struct Belief {
  LogNormal modulus, toughness;
  optimize::Performance median() const { return {modulus.median(), toughness.median()}; }
};

/// E[growth of the hypervolume over (0, 0)] when the pattern is simulated, in Pa^2. `front`: by increasing modulus
/// (optimize::pareto_front). The area between two steps of the front splits into a product of the two beliefs, so the
/// sum over steps is exact.
double expected_improvement(const Belief& belief, std::span<const optimize::Performance> front);

/// Covariance of the errors of beliefs about several patterns, n x n each; empty: none.
struct SharedErrors {
  Eigen::MatrixXd log_modulus, log_toughness;
};

/// Indices of up to `count` beliefs, chosen one by one for the largest expected improvement over the front as if those
/// already chosen had come out at their medians: these are in the front, and patterns correlated with them are no
/// longer uncertain.
std::vector<std::size_t> best_improvements(std::vector<Belief> beliefs, std::vector<optimize::Performance> front,
                                           int count, SharedErrors shared = {});

}  // namespace nacre::explore
