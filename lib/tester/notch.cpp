#include "tester/notch.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "thesis/constants.hpp"

namespace nacre::tester {

void cut_notch(fem::Grid& grid, int refinement) {
  const int columns = grid.columns / refinement, rows = grid.rows / refinement;
  const int full_width = thesis::kToughnessUnitsX * 2 * thesis::kPixelsPerSide;
  const int notch_length = columns * thesis::kNotchElements / full_width;
  const double cut_depth = static_cast<double>(columns) * thesis::kCutElements / full_width;
  const double half_angle_slope = std::tan(0.5 * thesis::kCutAngle * std::numbers::pi / 180.0);
  const int axis_row = rows / 2;
  const auto removed = [&](int row, int column) {
    if (row == axis_row && column < notch_length) return true;
    const double depth_left = cut_depth - (column + 0.5);
    return depth_left > 0.0 && std::abs(row - axis_row) <= depth_left * half_angle_slope;
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (!removed(row / refinement, column / refinement)) continue;
      const int element = grid.index(row, column);
      grid.phase[element] = fem::Phase::empty;
      grid.young_pa[element] = 0.0;
      grid.threshold_j_per_m3[element] = std::numeric_limits<double>::infinity();
    }
  }
}

}  // namespace nacre::tester
