#pragma once
// Selection of NSGA-II (K. Deb et al., IEEE Trans. Evol. Comput. 6, 182 (2002)).

#include <cstddef>
#include <span>
#include <vector>

#include "optimize/pareto.hpp"

namespace nacre::optimize {

/// Indices of the best `most` points by non-dominated rank, within a rank by crowding distance, the best first.
std::vector<std::size_t> best_by_rank(std::span<const Performance> points, std::size_t most);

}  // namespace nacre::optimize
