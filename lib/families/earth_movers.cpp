#include "families/earth_movers.hpp"

#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace nacre::families {
namespace {

using pattern::kFreePixels;
using pattern::kQuarter;
using pattern::Pattern;

constexpr double kCostUnit = 1e-6;  // pixels: costs are integers, so that transport is exact

struct QuarterCell {
  int row = 0, column = 0;
};

std::array<QuarterCell, kFreePixels> cells() {
  std::array<QuarterCell, kFreePixels> result{};
  for (int row = 0, index = 0; row < kQuarter; ++row)
    for (int column = row; column < kQuarter; ++column) result[index++] = {row, column};
  return result;
}

using CostTable = std::array<std::array<std::int64_t, kFreePixels>, kFreePixels>;

const CostTable& cost_table() {
  static const CostTable table = [] {
    CostTable result{};
    for (int a = 0; a < kFreePixels; ++a)
      for (int b = 0; b < kFreePixels; ++b) result[a][b] = std::llround(free_pixel_distance(a, b) / kCostUnit);
    return result;
  }();
  return table;
}

/// Soft cells of the quarter.
std::int64_t soft_cells(const Pattern& pattern) {
  std::int64_t count = 0;
  for (int i = 0; i < kFreePixels; ++i)
    if (((pattern.bits() >> i) & 1u) == 0) count += quarter_cells(i);
  return count;
}

/// Surplus (positive) or missing (negative) earth at one free pixel.
struct Surplus {
  int pixel = 0;
  std::int64_t amount = 0;
};

std::int64_t cheapest_transport(const std::vector<Surplus>& sources, const std::vector<Surplus>& sinks) {
  using Graph = lemon::SmartDigraph;
  Graph graph;
  graph.reserveNode(sources.size() + sinks.size());
  graph.reserveArc(sources.size() * sinks.size());
  for (std::size_t i = 0; i < sources.size() + sinks.size(); ++i) graph.addNode();
  Graph::ArcMap<std::int64_t> cost(graph);
  Graph::NodeMap<std::int64_t> supply(graph);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Graph::Node from = Graph::nodeFromId(i);
    supply[from] = sources[i].amount;
    for (std::size_t j = 0; j < sinks.size(); ++j) {
      const Graph::Node to = Graph::nodeFromId(sources.size() + j);
      supply[to] = sinks[j].amount;
      cost[graph.addArc(from, to)] = cost_table()[sources[i].pixel][sinks[j].pixel];
    }
  }
  lemon::NetworkSimplex<Graph, std::int64_t, std::int64_t> simplex(graph);
  simplex.costMap(cost).supplyMap(supply);
  simplex.run();
  return simplex.totalCost<std::int64_t>();
}

}  // namespace

int quarter_cells(int index) { return Pattern::orbit_size(index) / 4; }

double free_pixel_distance(int a, int b) {
  static const std::array<QuarterCell, kFreePixels> kCells = cells();
  const QuarterCell from = kCells[a], to = kCells[b];
  return std::min(std::hypot(from.row - to.row, from.column - to.column),
                  std::hypot(from.row - to.column, from.column - to.row));
}

double earth_movers_distance(const Pattern& a, const Pattern& b) {
  const std::int64_t count_a = soft_cells(a), count_b = soft_cells(b);
  if (count_a == 0 || count_b == 0) return count_a == count_b ? 0.0 : std::numeric_limits<double>::infinity();
  // Earth that both have at a pixel is not moved: the cost is a metric. Amounts in units of 1 / (count_a count_b).
  std::vector<Surplus> sources, sinks;
  for (int i = 0; i < kFreePixels; ++i) {
    const bool soft_a = ((a.bits() >> i) & 1u) == 0, soft_b = ((b.bits() >> i) & 1u) == 0;
    const std::int64_t surplus = quarter_cells(i) * ((soft_a ? count_b : 0) - (soft_b ? count_a : 0));
    if (surplus > 0) sources.push_back({i, surplus});
    if (surplus < 0) sinks.push_back({i, surplus});
  }
  if (sources.empty()) return 0.0;
  return kCostUnit * static_cast<double>(cheapest_transport(sources, sinks)) / static_cast<double>(count_a * count_b);
}

}  // namespace nacre::families
