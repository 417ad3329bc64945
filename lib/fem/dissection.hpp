#pragma once
// Nested dissection of the rectangular grid: which unknowns are eliminated where. The grid is halved across its longer
// side until blocks of a few elements are left; an unknown is eliminated in the smallest block that holds all elements
// around its node. Fronts then stay small and dense: 80 x 40 elements need a third of the operations of a banded
// factorisation.

#include <array>
#include <cstdint>
#include <vector>

#include "fem/frontal_kernel.hpp"
#include "fem/grid.hpp"

namespace nacre::fem {

/// One block of elements. Its front is a dense symmetric matrix over `pivots`, then `border`, padded as FrontView says.
struct DissectionBlock {
  std::vector<int> pivots;  ///< unknowns eliminated here, 2 node + direction
  std::vector<int>
      border;  ///< unknowns that the block shares with the rest of the grid, in the order of its parent's rows
  /// Of the smallest blocks: their elements, and the row of the front of each of an element's eight unknowns (-1 held).
  std::vector<int> elements;
  std::vector<std::array<std::int16_t, 8>> element_rows;
  /// Of the others: the two halves, and where their borders go.
  std::array<int, 2> halves = {-1, -1};
  std::array<std::vector<BorderRun>, 2> half_runs;
  int pivot_count() const { return pivots.size(); }
  int border_count() const { return border.size(); }
};

/// The blocks in the order of elimination: halves before the block they divide, the whole grid last.
struct DissectionPlan {
  int unknowns = 0;  ///< 2 per node, held ones included
  std::vector<DissectionBlock> blocks;
};

/// Plan for a grid in which the unknowns marked in `held` (2 per node) are prescribed.
DissectionPlan dissect(const Grid& grid, const std::vector<char>& held);

}  // namespace nacre::fem
