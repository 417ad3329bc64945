#include "crack/distances.hpp"

#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

namespace nacre::crack {
namespace {

using QueuedElement = std::pair<double, int>;  // cost, element: of equal costs the lower element first
using Queue = std::priority_queue<QueuedElement, std::vector<QueuedElement>, std::greater<>>;

void spread(const fem::Grid& grid, Queue& queue, const ElementCost& cost, const std::function<bool(int)>& arrived,
            Distances& distances) {
  while (!queue.empty()) {
    const auto [distance, element] = queue.top();
    queue.pop();
    if (distance > distances.cost[element]) continue;  // a shorter path was found meanwhile
    if (arrived && arrived(element)) {
      distances.arrived = element;
      return;
    }
    const int row = element / grid.columns, column = element % grid.columns;
    const double own_cost = cost(element);
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, grid.columns - 1); ++c) {
        const int next = grid.index(r, c);
        if (next == element) continue;
        const double length = r != row && c != column ? std::numbers::sqrt2 : 1.0;
        const double reached = distance + 0.5 * length * (own_cost + cost(next));
        if (!(reached < distances.cost[next])) continue;
        distances.cost[next] = reached;
        distances.previous[next] = element;
        queue.emplace(reached, next);
      }
  }
}

void add_origins(const std::vector<int>& origins, Queue& queue, Distances& distances) {
  for (const int element : origins) {
    distances.cost[element] = 0.0;
    distances.previous[element] = -1;
    queue.emplace(0.0, element);
  }
}

}  // namespace

Distances distances_from(const fem::Grid& grid, const std::vector<int>& origins, const ElementCost& cost,
                         const std::function<bool(int)>& arrived) {
  const auto count = static_cast<std::size_t>(grid.element_count());
  Distances distances{std::vector<double>(count, kImpassable), std::vector<int>(count, -1), std::nullopt};
  Queue queue;
  add_origins(origins, queue, distances);
  spread(grid, queue, cost, arrived, distances);
  return distances;
}

void shorten(const fem::Grid& grid, const std::vector<int>& origins, const ElementCost& cost, Distances& distances) {
  Queue queue;
  add_origins(origins, queue, distances);
  spread(grid, queue, cost, {}, distances);
}

double step_length(const fem::Grid& grid, int from, int to) {
  const bool diagonal = from / grid.columns != to / grid.columns && from % grid.columns != to % grid.columns;
  return diagonal ? std::numbers::sqrt2 : 1.0;
}

}  // namespace nacre::crack
