#pragma once
// DGEMO: diversity-guided multi-objective Bayesian optimisation (NeurIPS 2020).

#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// DGEMO (Konakovic Lukovic, Tian, Matusik 2020) for two objectives: the front of the posterior means is discovered
/// over the box of the free pixels, families are assigned to its cells (dynamic programming for the graph cut), and the
/// batch takes the largest hypervolume improvement of every family in turn. Points are rounded and repaired to patterns
/// and judged as such.
std::vector<pattern::Pattern> dgemo_batch(const BatchRequest& batch_request);

}  // namespace nacre::explore
