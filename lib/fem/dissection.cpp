#include "fem/dissection.hpp"

#include <algorithm>
#include <cassert>

#include "fem/element.hpp"

namespace nacre::fem {
namespace {

/// Blocks are not cut further once they have this many elements: smaller ones need fewer operations but more fronts.
constexpr int kSmallestBlock = 12;

/// Elements [left, right) x [bottom, top).
struct Rectangle {
  int left, right, bottom, top;
  int elements() const { return (right - left) * (top - bottom); }
};

class Dissector {
 public:
  Dissector(const Grid& grid, const std::vector<char>& held)
      : grid_(grid), held_(held), place_(held.size(), std::int16_t{-1}) {}

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
    assign_places(r, block);
    plan.blocks.push_back(std::move(block));
    return static_cast<int>(plan.blocks.size()) - 1;
  }

  DissectionPlan plan;

 private:
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
          if (!held_[static_cast<std::size_t>(unknown)]) add_unknown(r, unknown, block);
        }
  }

  void join_borders(const Rectangle& r, DissectionBlock& block) const {
    std::vector<int> unknowns;
    for (const int half : block.halves) {
      const std::vector<int>& border = plan.blocks[static_cast<std::size_t>(half)].border;
      unknowns.insert(unknowns.end(), border.begin(), border.end());
    }
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
    for (const int unknown : unknowns) add_unknown(r, unknown, block);
  }

  void assign_places(const Rectangle& r, DissectionBlock& block) {
    assert(block.front_size() < INT16_MAX);
    std::int16_t next = 0;
    for (const std::vector<int>* unknowns : {&block.pivots, &block.border})
      for (const int unknown : *unknowns) place_[static_cast<std::size_t>(unknown)] = next++;
    if (block.halves[0] < 0) {
      place_elements(r, block);
    } else {
      for (std::size_t half = 0; half < 2; ++half)
        for (const int unknown : plan.blocks[static_cast<std::size_t>(block.halves[half])].border)
          block.half_places[half].push_back(place_[static_cast<std::size_t>(unknown)]);
    }
  }

  void place_elements(const Rectangle& r, DissectionBlock& block) const {
    for (int row = r.bottom; row < r.top; ++row)
      for (int column = r.left; column < r.right; ++column) {
        if (grid_.phase[static_cast<std::size_t>(grid_.index(row, column))] == Phase::empty) continue;
        const auto nodes = element_nodes(grid_, row, column);
        std::array<std::int16_t, 8> places;
        for (std::size_t a = 0; a < 8; ++a) {
          const auto unknown = static_cast<std::size_t>(2 * nodes[a / 2]) + a % 2;
          places[a] = held_[unknown] ? std::int16_t{-1} : place_[unknown];
        }
        block.elements.push_back(grid_.index(row, column));
        block.element_places.push_back(places);
      }
  }

  const Grid& grid_;
  const std::vector<char>& held_;
  std::vector<std::int16_t> place_;  ///< in the front of the block at hand
};

}  // namespace

DissectionPlan dissect(const Grid& grid, const std::vector<char>& held) {
  assert(held.size() == static_cast<std::size_t>(2 * (grid.columns + 1) * (grid.rows + 1)));
  Dissector dissector(grid, held);
  dissector.dissect({.left = 0, .right = grid.columns, .bottom = 0, .top = grid.rows});
  dissector.plan.unknowns = static_cast<int>(held.size());
  return std::move(dissector.plan);
}

}  // namespace nacre::fem
