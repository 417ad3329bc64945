#include "tester/notch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "thesis/constants.hpp"

namespace nacre::tester {

namespace {

constexpr int kFullWidth = thesis::kToughnessUnitsX * 2 * thesis::kPixelsPerSide;

/// In unrefined elements, of a specimen that is `columns` wide.
int notch_length_of(int columns) { return columns * thesis::kNotchElements / kFullWidth; }

void empty_element(fem::Grid& grid, int element) {
  grid.phase[element] = fem::Phase::empty;
  grid.young_pa[element] = 0.0;
  grid.threshold_j_per_m3[element] = std::numeric_limits<double>::infinity();
}

/// Area of the unit square at (left, bottom) outside the circle of that radius around the origin. Columns of equal
/// width, each exact in height, so that the area goes smoothly with the radius.
double area_outside(double left, double bottom, double radius) {
  constexpr int kColumns = 16;
  double inside = 0.0;
  for (int i = 0; i < kColumns; ++i) {
    const double x = left + (i + 0.5) / kColumns;
    const double half_chord = std::sqrt(std::max(0.0, radius * radius - x * x));
    inside += std::max(0.0, std::min(bottom + 1.0, half_chord) - std::max(bottom, -half_chord)) / kColumns;
  }
  return 1.0 - inside;
}

}  // namespace

void cut_notch(fem::Grid& grid, int refinement) {
  const int columns = grid.columns / refinement, rows = grid.rows / refinement;
  const int notch_length = notch_length_of(columns);
  const double cut_depth = static_cast<double>(columns) * thesis::kCutElements / kFullWidth;
  const double half_angle_slope = std::tan(0.5 * thesis::kCutAngle * std::numbers::pi / 180.0);
  const int axis_row = rows / 2;
  const auto removed = [&](int row, int column) {
    if (row == axis_row && column < notch_length) return true;
    const double depth_left = cut_depth - (column + 0.5);
    return depth_left > 0.0 && std::abs(row - axis_row) <= depth_left * half_angle_slope;
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (removed(row / refinement, column / refinement)) empty_element(grid, grid.index(row, column));
    }
  }
}

void round_notch_root(fem::Grid& grid, int refinement, double root_radius) {
  if (root_radius == 0.0) return;
  constexpr double kLeastArea = 0.05;  // less of an element carries nothing
  const double radius = root_radius * grid.columns;
  const double centre_x = notch_length_of(grid.columns / refinement) * refinement - radius;
  const double centre_y = (grid.rows / refinement / 2 + 0.5) * refinement;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int element = grid.index(row, column);
      if (grid.phase[element] == fem::Phase::empty) continue;
      const double area = area_outside(column - centre_x, row - centre_y, radius);
      if (area < kLeastArea) {
        empty_element(grid, element);
      } else if (area < 1.0) {
        grid.young_pa[element] *= area;
        grid.threshold_j_per_m3[element] *= area;
        if (!grid.laws.yield_pa.empty()) grid.laws.yield_pa[element] *= area;
      }
    }
}

}  // namespace nacre::tester
