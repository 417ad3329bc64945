#include "fem/dissection.hpp"

#include <algorithm>
#include <cassert>

#include "fem/element.hpp"

namespace nacre::fem {
namespace {

/// Blocks are not cut further once they have this many elements: smaller ones need fewer operations but more fronts.
constexpr int kSmallestBlock = 20;

/// Elements [left, right) x [bottom, top).
struct Rectangle {
  int left, right, bottom, top;
  int elements() const { return (right - left) * (top - bottom); }
};

class Dissector {
 public:
  Dissector(const Grid& grid, const std::vector<char>& held) : grid_(grid), held_(held), row_(held.size(), kNoRow) {
    dissect({.left = 0, .right = grid.columns, .bottom = 0, .top = grid.rows});
    plan.unknowns = held.size();
    // From the whole grid down, so that every border follows the rows it goes to and is moved in few long runs.
    for (std::size_t k = plan.blocks.size(); k-- > 0;) {
      DissectionBlock& block = plan.blocks[k];
      number_rows(block);
      if (block.halves[0] < 0)
        place_elements(rectangles_[k], block);
      else
        for (std::size_t half = 0; half < 2; ++half) place_border(half, block);
    }
  }

  DissectionPlan plan;

 private:
  static constexpr std::int16_t kNoRow = -1;

  /// Index of the block of that rectangle.
  int dissect(const Rectangle& r) {
    DissectionBlock block;
    if (r.elements() <= kSmallestBlock) {
      collect_unknowns(r, block);
    } else {
      const auto [first, second] = halved(r);
      block.halves = {dissect(first), dissect(second)};
      join_borders(r, block);
    }
    plan.blocks.push_back(std::move(block));
    rectangles_.push_back(r);
    return static_cast<int>(plan.blocks.size()) - 1;
  }

  static std::pair<Rectangle, Rectangle> halved(const Rectangle& r) {
    const int width = r.right - r.left, height = r.top - r.bottom;
    Rectangle first = r, second = r;
    if (width >= height)
      first.right = second.left = r.left + width / 2;
    else
      first.top = second.bottom = r.bottom + height / 2;
    return {first, second};
  }

  /// Whether all elements around the node lie in the rectangle.
  bool enclosed(const Rectangle& r, int unknown) const {
    const int node = unknown / 2, row = node / (grid_.columns + 1), column = node % (grid_.columns + 1);
    return (column > r.left || r.left == 0) && (column < r.right || r.right == grid_.columns) &&
           (row > r.bottom || r.bottom == 0) && (row < r.top || r.top == grid_.rows);
  }

  void add_unknown(const Rectangle& r, int unknown, DissectionBlock& block) const {
    (enclosed(r, unknown) ? block.pivots : block.border).push_back(unknown);
  }

  void collect_unknowns(const Rectangle& r, DissectionBlock& block) const {
    for (int column = r.left; column <= r.right; ++column)
      for (int row = r.bottom; row <= r.top; ++row)
        for (int direction = 0; direction < 2; ++direction) {
          const int unknown = 2 * (row * (grid_.columns + 1) + column) + direction;
          if (!held_[unknown]) add_unknown(r, unknown, block);
        }
  }

  void join_borders(const Rectangle& r, DissectionBlock& block) const {
    std::vector<int> unknowns;
    for (const int half : block.halves) {
      const std::vector<int>& border = plan.blocks[half].border;
      unknowns.insert(unknowns.end(), border.begin(), border.end());
    }
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
    for (const int unknown : unknowns) add_unknown(r, unknown, block);
  }

  void number_rows(const DissectionBlock& block) {
    std::int16_t next = 0;
    for (const int unknown : block.pivots) row_[unknown] = next++;
    const int pivot_rows = padded_front_rows(block.pivot_count());
    assert(pivot_rows + block.border_count() < INT16_MAX);
    next = static_cast<std::int16_t>(pivot_rows);
    for (const int unknown : block.border) row_[unknown] = next++;
  }

  void place_border(std::size_t half, DissectionBlock& block) {
    const auto row = [this](int unknown) { return row_[unknown]; };
    std::vector<int>& border = plan.blocks[block.halves[half]].border;
    std::sort(border.begin(), border.end(), [&](int a, int b) { return row(a) < row(b); });
    std::vector<BorderRun>& runs = block.half_runs[half];
    for (std::size_t i = 0; i < border.size(); ++i) {
      if (runs.empty() || runs.back().row + runs.back().count != row(border[i]))
        runs.push_back({.from = static_cast<std::int16_t>(i), .row = row(border[i]), .count = 0});
      ++runs.back().count;
    }
  }

  void place_elements(const Rectangle& r, DissectionBlock& block) const {
    for (int row = r.bottom; row < r.top; ++row)
      for (int column = r.left; column < r.right; ++column) {
        if (grid_.phase[grid_.index(row, column)] == Phase::empty) continue;
        const auto nodes = element_nodes(grid_, row, column);
        std::array<std::int16_t, 8> rows;
        for (std::size_t a = 0; a < 8; ++a) {
          const auto unknown = static_cast<std::size_t>(2 * nodes[a / 2]) + a % 2;
          rows[a] = held_[unknown] ? kNoRow : row_[unknown];
        }
        block.elements.push_back(grid_.index(row, column));
        block.element_rows.push_back(rows);
      }
  }

  const Grid& grid_;
  const std::vector<char>& held_;
  std::vector<Rectangle> rectangles_;
  std::vector<std::int16_t> row_;  ///< in the front of the block at hand
};

}  // namespace

DissectionPlan dissect(const Grid& grid, const std::vector<char>& held) {
  assert(held.size() == static_cast<std::size_t>(2 * (grid.columns + 1) * (grid.rows + 1)));
  return Dissector(grid, held).plan;
}

}  // namespace nacre::fem
