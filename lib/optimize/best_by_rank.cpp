#include "optimize/best_by_rank.hpp"

#include <algorithm>
#include <numeric>

namespace nacre::optimize {

std::vector<std::size_t> best_by_rank(std::span<const Performance> points, std::size_t most) {
  const std::vector<int> ranks = non_dominated_ranks(points);
  const std::vector<double> crowding = crowding_distances(points, ranks);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : crowding[a] > crowding[b];
  });
  order.resize(std::min(order.size(), most));
  return order;
}

}  // namespace nacre::optimize
