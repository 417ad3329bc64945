#pragma once
// Expected hypervolume improvement in closed form: E[growth] = sum over the steps of the front of the product of two
// expected excesses.

#include <Eigen/Dense>
#include <optional>
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
  double noise_variance = 0.0;  ///< of the logarithm of toughness in the test that is thought of; 0: it settles all
  /// Where the front takes the pattern to be, when it is evaluated already: what is thought of is one more specimen.
  std::optional<optimize::Performance> present = {};
  /// What the expected toughness may be after that test. Its mean is that of `toughness`, its variance the part that
  /// the test settles.
  LogNormal toughness_ahead() const;
  optimize::Performance median() const { return {modulus.median(), toughness_ahead().median()}; }
};

/// E[growth of the hypervolume over (0, 0)] when the pattern is simulated, in Pa^2. `front`: by increasing modulus
/// (optimize::pareto_front). The area between two steps of the front splits into a product of the two beliefs, so the
/// sum over steps is exact. With noise it is that of the hypervolume of posterior means: a knowledge gradient (S.
/// Daulton et al., 2023). Of a pattern without `present`.
double expected_improvement(const Belief& belief, std::span<const optimize::Performance> front);

/// E[growth of the hypervolume of `points`] when one more specimen is tested of the pattern that is one of them
/// (`present`), in Pa^2: it may fall behind others, or put them behind it. Not negative.
double expected_regrowth(const Belief& belief, std::span<const optimize::Performance> points);

/// Covariance of the errors of beliefs about several patterns, n x n each; empty: none.
struct SharedErrors {
  Eigen::MatrixXd log_modulus, log_toughness;
};

/// Indices of up to `count` beliefs, chosen one by one for the largest expected improvement over the front of `points`
/// as if those already chosen had come out at their medians: these are in the front, and patterns correlated with them
/// are no longer as uncertain.
std::vector<std::size_t> best_improvements(std::vector<Belief> beliefs, std::vector<optimize::Performance> points,
                                           int count, SharedErrors shared = {});

}  // namespace nacre::explore
