#pragma once
// How much a simulation can be expected to enlarge the dominated area, in closed form.

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

/// Indices of up to `count` beliefs, chosen one by one for the largest expected improvement over the front and, as if
/// they came true, the medians of those already chosen.
std::vector<std::size_t> best_improvements(std::span<const Belief> beliefs, std::vector<optimize::Performance> front,
                                           int count);

}  // namespace nacre::explore
