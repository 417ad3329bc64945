#pragma once
// The toughness of a design: the mean over its specimens, as a laboratory reports it.

#include <optional>
#include <vector>

#include "tester/toughness.hpp"

namespace nacre::tester {

/// T of a design from n specimens. Deviations are nothing with one specimen.
struct ExpectedToughness {
  double toughness_pa = 0.0;               ///< arithmetic mean
  std::optional<double> toughness_sd_pa;   ///< scatter between specimens, over n - 1
  std::optional<double> toughness_se_pa;   ///< standard error of the mean: sd / sqrt(n)
  std::vector<ToughnessResult> specimens;  ///< specimens 0 .. n - 1, each with its curve
};

/// Of at least one specimen.
ExpectedToughness expected_toughness_of(std::vector<ToughnessResult> specimens);

/// Tests specimens 0 .. count - 1, count >= 1, on up to `threads` threads (0: all allowed cores): same bits for any
/// number of them. simulation.specimen is not used. Without strength_cv and `strength_scatter` all are alike.
/// Error: the first specimen whose test fails, and why.
Result<ExpectedToughness> expected_toughness(const Simulation& simulation, int count,
                                             const Discretisation& discretisation = {}, int threads = 0);

}  // namespace nacre::tester
