#pragma once
// Shortest paths over the elements of a grid, steps to the eight neighbours (Dijkstra).

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "fem/grid.hpp"

namespace nacre::crack {

/// Cost of an element that no path crosses.
inline constexpr double kImpassable = std::numeric_limits<double>::infinity();

/// Cost of every element: a step costs its length (1, or the root of 2) times the mean of both elements' costs.
using ElementCost = std::function<double(int)>;

struct Distances {
  std::vector<double> cost;    ///< per element; infinity where it is unreachable
  std::vector<int> previous;   ///< the element before it on the path, -1 at origins
  std::optional<int> arrived;  ///< the first element reached that `arrived` accepts
};

/// Shortest paths from the nearest of `origins` to all elements, or until one is reached that `arrived` accepts.
Distances distances_from(const fem::Grid& grid, const std::vector<int>& origins, const ElementCost& cost,
                         const std::function<bool(int)>& arrived = {});

/// Adds further origins: lowers the distances of all elements that are nearer to these.
void shorten(const fem::Grid& grid, const std::vector<int>& origins, const ElementCost& cost, Distances& distances);

/// Distance between the centres of neighbouring elements, in elements.
double step_length(const fem::Grid& grid, int from, int to);

}  // namespace nacre::crack
