#pragma once
// One unit of a layout as printed: the material of each cell, before constants are assigned.

#include <vector>

#include "pattern/layout.hpp"

namespace nacre::tester {

/// Elements along one side of a unit: the pattern's resolution doubled.
inline constexpr int kElementsPerUnit = 2 * pattern::kSide;

/// A unit in square cells, `cells` along an element's side, row 0 at the bottom.
struct PrintedUnit {
  int cells = 1;
  std::vector<double> rigid_fraction;  ///< 0 soft, 0.5 interface, 1 rigid
  /// Share of a cell that is interface between neighbours along x, and along y (the grid's axes); corners are neither.
  std::vector<double> joins_x, joins_y;

  int side() const { return kElementsPerUnit * cells; }
  std::size_t index(int row, int column) const { return row * side() + column; }
};

/// Figure 2-5C: an element takes the value of the pixels it touches when they agree, else it is interface.
PrintedUnit printed_unit(const pattern::Layout& layout);

/// The same with rigid regions grown by `pixels` > 0 on every side, the interface around them keeping its width of half
/// a pixel; cells that a boundary crosses hold the mean over their area. Tends to printed_unit() as pixels -> 0.
PrintedUnit overprinted_unit(const pattern::Layout& layout, double pixels, int cells);

/// Rigid fraction of the unit with every cell split into parts x parts: averaged over a square of `blur_pixels` (one
/// pixel is two elements) and over the part itself. Zero blur copies the values as they are.
std::vector<double> blurred_fractions(const PrintedUnit& unit, double blur_pixels, int parts);

}  // namespace nacre::tester
