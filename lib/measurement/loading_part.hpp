#pragma once
// Where the pull begins in a record: holds, tares and preloads stand before it.

#include <cstddef>
#include <vector>

#include "tester/curve.hpp"

namespace nacre::measurement {

/// The beginning of the pull, and the strain that counts as its zero.
struct PullStart {
  std::size_t row = 0;  ///< 0: the record begins with the pull
  double zero_strain = 0.0;
  bool was_tared = false;  ///< the strain jumps there
};

/// Goes back from the rise between 10 and 40 % of the peak stress to where the strain stands still or jumps. `time_s`
/// may be empty: then rows count as equally far apart.
PullStart pull_start(const std::vector<double>& time_s, const tester::Curve& curve);

/// First and last row of the rise from 10 to 40 % of the peak stress.
struct Rise {
  std::size_t first = 0, last = 0;
};
Rise rise_of(const tester::Curve& curve, double from, double to);

/// Standard deviation of the noise of the first `count` values, from their second differences: a ramp has none.
double noise_of(const std::vector<double>& values, std::size_t count);

}  // namespace nacre::measurement
