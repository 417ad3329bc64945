#pragma once
// Cracks on small grids drawn as text.

#include <string>
#include <vector>

#include "crack/crack_record.hpp"

namespace nacre::crack {

inline constexpr double kSize = 260e-6;

/// A specimen with its crack, first row of text at the top: `.` standing and `x` failed rigid, `s` failed soft, `i`
/// failed interface, `o` notch. Elements fail column by column, those of one column together.
struct Drawing {
  fem::Grid grid;
  std::vector<tester::Break> order;
};

inline Drawing draw(const std::vector<std::string>& lines) {
  Drawing drawing;
  fem::Grid& grid = drawing.grid;
  grid.rows = static_cast<int>(lines.size());
  grid.columns = static_cast<int>(lines.front().size());
  grid.element_size_m = kSize;
  grid.phase.assign(grid.element_count(), fem::Phase::rigid);
  for (int column = 0; column < grid.columns; ++column)
    for (int row = 0; row < grid.rows; ++row) {
      const char sign = lines[grid.rows - 1 - row][column];
      const int e = grid.index(row, column);
      fem::Phase& phase = grid.phase[e];
      if (sign == 's') phase = fem::Phase::soft;
      if (sign == 'i') phase = fem::Phase::interface;
      if (sign == 'o') phase = fem::Phase::empty;
      if (sign == 'x' || sign == 's' || sign == 'i') drawing.order.push_back({e, 0.01 + 1e-3 * column});
    }
  return drawing;
}

inline CrackRecord drawn_record(const std::vector<std::string>& lines) {
  Drawing drawing = draw(lines);
  return crack_record(drawing.grid, std::move(drawing.order));
}

}  // namespace nacre::crack
