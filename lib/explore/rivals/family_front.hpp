#pragma once
// Assignment of families to cells of a two-objective front (the sparse approximation of DGEMO): a shortest path over
// the chain of cells.

#include <vector>

namespace nacre::explore {

/// Prices of an assignment, as DGEMO ships them.
struct FamilyPrices {
  double change = 10.0;  ///< of two neighbouring cells with different families
  double family = 10.0;  ///< of every family that is used at all
};

struct FamilyAssignment {
  std::vector<int> family;  ///< per cell
  double price = 0.0;
};

/// Assigns a family to every cell of the chain: smallest sum of prices[cell][family], changes between neighbours and
/// families used. Between two objectives the cells of the front form a chain, so the graph cut of DGEMO becomes dynamic
/// programming: exact without the price per family, O(cells x families). Families are then given up one by one while
/// that pays. Every row of `prices` has one entry per family.
FamilyAssignment assign_families(const std::vector<std::vector<double>>& prices, const FamilyPrices& settings);

}  // namespace nacre::explore
