#pragma once
// NSGA-II over patterns (K. Deb et al., 2002; thesis 2.3.3), with mutation alone.

#include <memory>

#include "explore/search.hpp"

namespace nacre::explore {

/// How NSGA-II makes an offspring from its parent (2.3.3, 3.2.5).
enum class Variation {
  three_way,                ///< the custom mutation
  single_pixel,             ///< baseline 1: single pixels, accumulated until the child is feasible and new
  single_pixel_rolled_back  ///< baseline 2: a single pixel that makes the child infeasible or old is taken back
};

/// A batch is handed out as far as so many proposed mutants fill it; a search ends when they bring nothing (3.2.5).
inline constexpr int kMaximumProposals = 300000;

/// NSGA-II without crossover: parents by binary tournament on rank, then crowding; `batch` offspring a generation, none
/// of them seen before; the best `population` of parents and offspring survive. Ends early only when no new offspring
/// are found.
std::unique_ptr<Search> make_evolution(const SearchSettings& settings, Variation variation);

}  // namespace nacre::explore
