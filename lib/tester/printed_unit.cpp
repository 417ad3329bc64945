#include "tester/printed_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nacre::tester {
namespace {

using pattern::kSide;

PrintedUnit empty_unit(int cells) {
  PrintedUnit unit{.cells = cells, .rigid_fraction = {}, .joins_x = {}, .joins_y = {}};
  const auto count = static_cast<std::size_t>(unit.side() * unit.side());
  for (std::vector<double>* field : {&unit.rigid_fraction, &unit.joins_x, &unit.joins_y}) field->assign(count, 0.0);
  return unit;
}

int wrapped(int index, int count) { return (index % count + count) % count; }

/// Mean over the interval [start, end] (inside the cell [0, 1]) of the moving average of width `width` of the
/// indicator of the cell at [offset, offset + 1]; lengths in cells.
double moving_average_weight(double start, double end, double width, int offset) {
  const auto ramp_area = [](double t) { return t > 0.0 ? 0.5 * t * t : 0.0; };
  const auto second_integral = [&](double t) { return ramp_area(t - offset) - ramp_area(t - offset - 1.0); };
  const double half = 0.5 * width;
  const double sum = (second_integral(end + half) - second_integral(start + half)) -
                     (second_integral(end - half) - second_integral(start - half));
  return sum / (width * (end - start));
}

/// Row s: weights of the cells at offsets -reach..reach in the mean over part s of `parts` equal parts of a cell.
std::vector<std::vector<double>> blur_weights(double width, int parts, int reach) {
  std::vector<std::vector<double>> weights(parts);
  for (int part = 0; part < parts; ++part) {
    std::vector<double>& row = weights[part];
    double sum = 0.0;
    for (int offset = -reach; offset <= reach; ++offset) {
      const double start = static_cast<double>(part) / parts, end = static_cast<double>(part + 1) / parts;
      row.push_back(width > 0.0 ? moving_average_weight(start, end, width, offset) : offset == 0 ? 1.0 : 0.0);
      sum += row.back();
    }
    for (double& weight : row) weight /= sum;
  }
  return weights;
}

/// The materials of some part of a layout.
struct Surroundings {
  bool rigid = false, soft = false;
  bool mixed() const { return rigid && soft; }
};

/// The layout with rigid pixels grown by `reach` pixels on every side. Pixel k is centred at coordinate k; along either
/// axis the boundaries lie at k + low and k + high, between which the grown layout is constant.
class GrownLayout {
 public:
  GrownLayout(const pattern::Layout& layout, double reach) {
    reach *= 1.0 + 1e-9;  // so that no two boundaries coincide
    const double under = fraction(0.5 - reach), over = fraction(0.5 + reach);
    low_ = std::min(under, over);
    high_ = std::max(under, over);
    for (int row = 0; row < kStrips; ++row)
      for (int column = 0; column < kStrips; ++column)
        rigid_[row * kStrips + column] = any_near(layout, middle(row), middle(column), 0.5 + reach);
    for (int row = 0; row < kSpan; ++row)
      for (int column = 0; column < kSpan; ++column)
        below(row + 1, column + 1) = below(row, column + 1) + below(row + 1, column) - below(row, column) +
                                     (rigid(row - kMargin, column - kMargin) ? 1 : 0);
  }

  double low() const { return low_; }
  double high() const { return high_; }
  /// The strip that a coordinate lies in; strips go on beyond the unit.
  int strip(double coordinate) const {
    const int pixel = static_cast<int>(std::floor(coordinate));
    const double rest = coordinate - pixel;
    return 2 * pixel + (rest < low_ ? -1 : rest < high_ ? 0 : 1);
  }
  /// The materials of these strips, the last ones included; up to kMargin beyond the unit.
  Surroundings within(int first_row, int last_row, int first_column, int last_column) const {
    const int bottom = first_row + kMargin, top = last_row + kMargin + 1;
    const int left = first_column + kMargin, right = last_column + kMargin + 1;
    const int count = below(top, right) - below(bottom, right) - below(top, left) + below(bottom, left);
    return {.rigid = count > 0, .soft = count < (top - bottom) * (right - left)};
  }
  static double fraction(double value) { return value - std::floor(value); }

 private:
  static constexpr int kStrips = 2 * kSide, kMargin = 4, kSpan = kStrips + 2 * kMargin;

  bool rigid(int row_strip, int column_strip) const {
    return rigid_[wrapped(row_strip, kStrips) * kStrips + wrapped(column_strip, kStrips)];
  }
  /// Rigid strips below and to the left of a corner, from the margin on.
  int& below(int row, int column) { return below_[row * (kSpan + 1) + column]; }
  int below(int row, int column) const { return below_[row * (kSpan + 1) + column]; }
  double middle(int strip) const {
    const int pixel = strip / 2;
    return strip % 2 == 0 ? pixel + 0.5 * (low_ + high_) : pixel + 0.5 * (high_ + 1.0 + low_);
  }
  /// Whether a rigid pixel's centre lies within `distance` along both axes.
  static bool any_near(const pattern::Layout& layout, double y, double x, double distance) {
    const auto first = [&](double at) { return static_cast<int>(std::ceil(at - distance)); };
    for (int row = first(y); row < y + distance; ++row)
      for (int column = first(x); column < x + distance; ++column)
        if (layout.rigid(kSide - 1 - wrapped(row, kSide), wrapped(column, kSide))) return true;
    return false;
  }

  double low_ = 0.0, high_ = 0.0;
  std::array<bool, static_cast<std::size_t>(kStrips) * kStrips> rigid_{};
  std::array<int, static_cast<std::size_t>(kSpan + 1) * (kSpan + 1)> below_{};
};

constexpr double kInterfaceReach = 0.25;  ///< half the width of the interface, pixels

/// A piece of a cell's side over which nothing changes.
struct Piece {
  double share = 0.0;            ///< of the cell's side
  int strip = 0;                 ///< it lies in
  int first = 0, last = 0;       ///< strips within the interface's reach
  bool near_pixel_edge = false;  ///< within the interface's reach of the drawn pixel's edge
};

/// Pieces of cell `cell` along an axis, counted from the unit's edge.
std::vector<Piece> pieces_of(const GrownLayout& grown, int cell, int cells) {
  const double size = 0.5 / cells, start = -0.25 + cell * size;  // element 0 is centred on pixel 0
  std::vector<double> cuts = {start, start + size};
  for (const double boundary : {grown.low(), grown.high()})
    for (const double offset : {-kInterfaceReach, 0.0, kInterfaceReach}) {
      const double cut = start + GrownLayout::fraction(boundary + offset - start);
      if (cut < start + size) cuts.push_back(cut);
    }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double share = (cuts[i] - cuts[i - 1]) / size, middle = 0.5 * (cuts[i] + cuts[i - 1]);
    if (share <= 0.0) continue;
    const double from_edge = std::abs(GrownLayout::fraction(middle) - 0.5);
    pieces.push_back({.share = share,
                      .strip = grown.strip(middle),
                      .first = grown.strip(middle - kInterfaceReach),
                      .last = grown.strip(middle + kInterfaceReach),
                      .near_pixel_edge = from_edge < kInterfaceReach});
  }
  return pieces;
}

}  // namespace

PrintedUnit printed_unit(const pattern::Layout& layout) {
  const auto rigid = [&layout](int row_from_bottom, int column) {
    return layout.rigid(kSide - 1 - row_from_bottom % kSide, column % kSide);
  };
  PrintedUnit unit = empty_unit(1);
  for (int row = 0; row < kElementsPerUnit; ++row)
    for (int column = 0; column < kElementsPerUnit; ++column) {
      const int j = row / 2, i = column / 2, above = j + row % 2, right = i + column % 2;  // the tile repeats
      const int rigid_count = rigid(j, i) + rigid(j, right) + rigid(above, i) + rigid(above, right);
      const std::size_t e = unit.index(row, column);
      unit.rigid_fraction[e] = rigid_count == 4 ? 1.0 : rigid_count == 0 ? 0.0 : 0.5;
      if (unit.rigid_fraction[e] != 0.5) continue;
      if (row % 2 == 0)
        unit.joins_x[e] = 1.0;
      else if (column % 2 == 0)
        unit.joins_y[e] = 1.0;
    }
  return unit;
}

PrintedUnit overprinted_unit(const pattern::Layout& layout, double pixels, int cells) {
  const GrownLayout grown(layout, pixels);
  PrintedUnit unit = empty_unit(cells);
  std::vector<std::vector<Piece>> pieces;
  for (int cell = 0; cell < unit.side(); ++cell) pieces.push_back(pieces_of(grown, cell, cells));
  for (int row = 0; row < unit.side(); ++row)
    for (int column = 0; column < unit.side(); ++column) {
      const std::size_t e = unit.index(row, column);
      for (const Piece& y : pieces[row])
        for (const Piece& x : pieces[column]) {
          const double area = x.share * y.share;
          const Surroundings around = grown.within(y.first, y.last, x.first, x.last);
          unit.rigid_fraction[e] += area * (around.mixed() ? 0.5 : around.rigid ? 1.0 : 0.0);
          if (!around.mixed()) continue;
          const bool along_x = grown.within(y.strip, y.strip, x.first, x.last).mixed();
          const bool along_y = grown.within(y.first, y.last, x.strip, x.strip).mixed();
          if (along_x && !along_y && !y.near_pixel_edge) unit.joins_x[e] += area;
          if (along_y && !along_x && !x.near_pixel_edge) unit.joins_y[e] += area;
        }
    }
  return unit;
}

std::vector<double> blurred_fractions(const PrintedUnit& unit, double blur_pixels, int parts) {
  const int cells = unit.side(), side = cells * parts;
  const double width = 2.0 * blur_pixels * unit.cells;
  const int reach = width > 0.0 ? static_cast<int>(std::ceil(0.5 * width)) : 0;
  const auto weights = blur_weights(width, parts, reach);
  const auto blur_line = [&](auto value_at, int position) {
    const std::vector<double>& row = weights[position % parts];
    if (reach == 0) return value_at(position / parts);
    double sum = 0.0;
    for (int offset = -reach; offset <= reach; ++offset)
      sum += row[offset + reach] * value_at(wrapped(position / parts + offset, cells));
    return std::clamp(sum, 0.0, 1.0);
  };
  std::vector<double> along_x(cells * side), result(side * side);
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < side; ++column)
      along_x[row * side + column] = blur_line([&](int c) { return unit.rigid_fraction[unit.index(row, c)]; }, column);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      result[row * side + column] = blur_line([&](int r) { return along_x[r * side + column]; }, row);
  return result;
}

}  // namespace nacre::tester
