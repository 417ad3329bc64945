#pragma once
// NSGA-II on predictions of a surrogate, where an evaluation costs next to nothing (2.3.3).

#include <functional>
#include <span>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// Performance that a predictor gives each pattern; finite.
using Believed = std::function<std::vector<optimize::Performance>(std::span<const pattern::Pattern>)>;

struct SurrogateSearchSettings {
  int generations = 200;  ///< 2.3.3
  int population = 100;   ///< and offspring of a generation
  std::uint64_t seed = 1;
};

/// Everything that NSGA-II with the custom mutation visits on `believed`, in order of evaluation: no pattern twice (its
/// own duplicate set), none of `start`, which is the population that it begins with (filled up with random patterns).
std::vector<Evaluated> search_believed(const Believed& believed, std::span<const Evaluated> start,
                                       const SurrogateSearchSettings& settings);

/// The best of `samples` by rank, then crowding; all of them when there are no more than `count`.
std::vector<Evaluated> best_by_rank(std::span<const Evaluated> samples, std::size_t count);

}  // namespace nacre::explore
