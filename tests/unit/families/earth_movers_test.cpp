#include "families/earth_movers.hpp"

#include <gtest/gtest.h>
#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <cmath>

#include "base/random.hpp"
#include "families/distances.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::families {
namespace {

using pattern::kQuarter;
using pattern::Pattern;

std::vector<Pattern> patterns(int count, std::uint64_t seed = 1) {
  RandomStream random(seed, "families test");
  return pattern::stratified_patterns(count, random);
}

/// Transport between all soft cells of both quarters, nothing left out and no symmetry used.
double hundred_cell_distance(const Pattern& a, const Pattern& b) {
  std::vector<std::pair<int, int>> from, to;
  for (int row = 0; row < kQuarter; ++row)
    for (int column = 0; column < kQuarter; ++column) {
      if (!a.rigid(row, column)) from.emplace_back(row, column);
      if (!b.rigid(row, column)) to.emplace_back(row, column);
    }
  lemon::SmartDigraph graph;
  lemon::SmartDigraph::ArcMap<long long> cost(graph);
  lemon::SmartDigraph::NodeMap<long long> supply(graph);
  std::vector<lemon::SmartDigraph::Node> sources, sinks;
  for (std::size_t i = 0; i < from.size(); ++i)
    supply[sources.emplace_back(graph.addNode())] = static_cast<long long>(to.size());
  for (std::size_t j = 0; j < to.size(); ++j)
    supply[sinks.emplace_back(graph.addNode())] = -static_cast<long long>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t j = 0; j < to.size(); ++j)
      cost[graph.addArc(sources[i], sinks[j])] =
          std::llround(1e6 * std::hypot(from[i].first - to[j].first, from[i].second - to[j].second));
  lemon::NetworkSimplex<lemon::SmartDigraph, long long, long long> simplex(graph);
  simplex.costMap(cost).supplyMap(supply);
  simplex.run();
  return 1e-6 * static_cast<double>(simplex.totalCost<long long>()) / static_cast<double>(from.size() * to.size());
}

TEST(EarthMoversDistance, EqualsTransportBetweenTheHundredCells) {
  const std::vector<Pattern> some = patterns(16);
  for (std::size_t i = 1; i < some.size(); ++i)
    EXPECT_NEAR(earth_movers_distance(some[i - 1], some[i]), hundred_cell_distance(some[i - 1], some[i]), 2e-6);
}

TEST(EarthMoversDistance, IsAMetric) {
  const std::vector<Pattern> some = patterns(14, 2);
  const DistanceMatrix distances = earth_movers_distances(some);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(earth_movers_distance(some[i], some[i]), 0.0);
    for (std::size_t j = 0; j < some.size(); ++j) {
      EXPECT_NEAR(distances(i, j), earth_movers_distance(some[j], some[i]), 1e-5);
      EXPECT_TRUE(i == j || distances(i, j) > 0.0);
      for (std::size_t k = 0; k < some.size(); ++k)
        EXPECT_LE(distances(i, j), distances(i, k) + distances(k, j) + 1e-5);
    }
  }
}

TEST(EarthMoversDistance, IsTheWayThatOneSoftPixelGoes) {
  Pattern a = Pattern(pattern::kAllFreePixels), b = a;
  a.set(2, 2, false);
  b.set(5, 5, false);
  EXPECT_NEAR(earth_movers_distance(a, b), 3.0 * std::sqrt(2.0), 1e-6);
  EXPECT_TRUE(std::isinf(earth_movers_distance(a, Pattern(pattern::kAllFreePixels))));
}

}  // namespace
}  // namespace nacre::families
