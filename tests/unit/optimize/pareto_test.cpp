#include "optimize/pareto.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "../../instrumented.hpp"
#include "base/random.hpp"

namespace nacre::optimize {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGpa = 1e9, kMpa = 1e6;

/// Random points; `levels` > 0 draws from a coarse grid, so that ties and duplicates abound.
std::vector<Performance> random_points(int count, int levels, RandomStream& random) {
  std::vector<Performance> points;
  for (int i = 0; i < count; ++i) {
    const auto draw = [&] { return levels > 0 ? (1.0 + random.index(levels)) / levels : random.uniform(0.01, 1.0); };
    const double e = draw(), t = draw();
    points.push_back({e * kGpa, t * kMpa});
  }
  return points;
}

/// Ranks by peeling fronts off one after another, O(N^3).
std::vector<int> peeled_ranks(const std::vector<Performance>& points) {
  std::vector<int> ranks(points.size(), 0);
  for (int rank = 1; std::find(ranks.begin(), ranks.end(), 0) != ranks.end(); ++rank) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (ranks[i] != 0) continue;
      bool dominated = false;
      for (std::size_t j = 0; j < points.size(); ++j) dominated |= ranks[j] == 0 && dominates(points[j], points[i]);
      if (!dominated) front.push_back(i);
    }
    for (const std::size_t i : front) ranks[i] = rank;
  }
  return ranks;
}

/// Deb's crowding distance as published: one sort per objective and rank.
std::vector<double> published_crowding(const std::vector<Performance>& points, const std::vector<int>& ranks) {
  std::vector<double> distances(points.size(), 0.0);
  for (int rank = 1; rank <= *std::max_element(ranks.begin(), ranks.end()); ++rank) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (ranks[i] == rank) members.push_back(i);
    }
    for (const auto objective : {&Performance::modulus_pa, &Performance::toughness_pa}) {
      std::sort(members.begin(), members.end(),
                [&](std::size_t a, std::size_t b) { return points[a].*objective < points[b].*objective; });
      const double range = points[members.back()].*objective - points[members.front()].*objective;
      distances[members.front()] = distances[members.back()] = kInfinity;
      for (std::size_t k = 1; k + 1 < members.size(); ++k) {
        distances[members[k]] += (points[members[k + 1]].*objective - points[members[k - 1]].*objective) / range;
      }
    }
  }
  return distances;
}

bool covered(const std::vector<Performance>& points, double e, double t) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Performance& p) { return p.modulus_pa >= e && p.toughness_pa >= t; });
}

TEST(Dominance, IsStrictInOneObjectiveAtLeast) {
  EXPECT_TRUE(dominates({2, 1}, {1, 1}));
  EXPECT_TRUE(dominates({1, 2}, {1, 1}));
  EXPECT_FALSE(dominates({1, 1}, {1, 1}));
  EXPECT_FALSE(dominates({2, 1}, {1, 2}));
}

TEST(Ranks, EqualPeelingFrontsOffOneByOne) {
  RandomStream random(1, "test");
  for (const int levels : {0, 3, 7, 20}) {
    for (int trial = 0; trial < 40; ++trial) {
      const auto points = random_points(1 + random.index(60), levels, random);
      EXPECT_EQ(non_dominated_ranks(points), peeled_ranks(points)) << "levels " << levels;
    }
  }
  EXPECT_TRUE(non_dominated_ranks({}).empty());
}

TEST(Ranks, OfAHundredThousandPointsTakeAFractionOfASecond) {
  RandomStream random(2, "test");
  const auto points = random_points(100000, 0, random);
  const auto begin = std::chrono::steady_clock::now();
  const auto ranks = non_dominated_ranks(points);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, test::kPatience * std::chrono::seconds(1));
  EXPECT_EQ(std::count(ranks.begin(), ranks.end(), 1), static_cast<long>(pareto_front(points).size()));
}

TEST(Crowding, EqualsThePublishedDefinitionWithoutTies) {
  RandomStream random(3, "test");
  for (int trial = 0; trial < 40; ++trial) {
    const auto points = random_points(2 + random.index(60), 0, random);
    const auto ranks = non_dominated_ranks(points);
    const auto distances = crowding_distances(points, ranks), expected = published_crowding(points, ranks);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::isinf(expected[i])) {
        EXPECT_EQ(distances[i], kInfinity);
      } else {
        EXPECT_NEAR(distances[i], expected[i], 1e-12);
      }
    }
  }
}

TEST(Crowding, IsNeverNotANumberAmongDuplicates) {
  RandomStream random(4, "test");
  for (const int levels : {1, 2, 4}) {
    const auto points = random_points(50, levels, random);
    for (const double distance : crowding_distances(points, non_dominated_ranks(points))) {
      EXPECT_FALSE(std::isnan(distance));
      EXPECT_GE(distance, 0.0);
    }
  }
}

TEST(Front, HoldsEachNonDominatedPointOnceByIncreasingModulus) {
  RandomStream random(5, "test");
  for (const int levels : {0, 4}) {
    const auto points = random_points(50, levels, random);
    const auto ranks = non_dominated_ranks(points);
    const auto front = pareto_front(points);
    for (std::size_t i = 1; i < front.size(); ++i) {
      EXPECT_LT(front[i - 1].modulus_pa, front[i].modulus_pa);
      EXPECT_GT(front[i - 1].toughness_pa, front[i].toughness_pa);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(std::find(front.begin(), front.end(), points[i]) != front.end(), ranks[i] == 1);
    }
  }
}

TEST(Hypervolume, OfKnownFrontsIsTheirArea) {
  const std::vector<Performance> front = {{1 * kGpa, 3 * kMpa}, {2 * kGpa, 1 * kMpa}, {0.5 * kGpa, 0.5 * kMpa}};
  EXPECT_DOUBLE_EQ(hypervolume_staircase_gpa_mpa(front), 3.0 + 1.0);
  EXPECT_DOUBLE_EQ(hypervolume_polygon_gpa_mpa(front), 3.0 + 2.0);
  EXPECT_DOUBLE_EQ(hypervolume_staircase_gpa_mpa(std::vector<Performance>{{2 * kGpa, 1 * kMpa}}), 2.0);
  EXPECT_DOUBLE_EQ(hypervolume_polygon_gpa_mpa(std::vector<Performance>{{2 * kGpa, 1 * kMpa}}), 2.0);
  EXPECT_EQ(hypervolume_staircase_gpa_mpa({}), 0.0);
  EXPECT_EQ(hypervolume_polygon_gpa_mpa({}), 0.0);
  EXPECT_EQ(hypervolume_staircase_gpa_mpa(std::vector<Performance>{{-1.0, 5 * kMpa}, {kGpa, 0.0}}), 0.0);
}

TEST(Hypervolume, CountsTheCellsOfAGridThatAreDominated) {
  // On a grid of `levels` the dominated region is a whole number of cells.
  RandomStream random(6, "test");
  for (const int levels : {3, 8, 16}) {
    const auto a = random_points(6, levels, random), b = random_points(6, levels, random);
    int in_a = 0, in_either_alone = 0;
    for (int i = 0; i < levels; ++i) {
      for (int j = 0; j < levels; ++j) {
        const double e = (i + 0.5) / levels * kGpa, t = (j + 0.5) / levels * kMpa;
        in_a += covered(a, e, t);
        in_either_alone += covered(a, e, t) != covered(b, e, t);
      }
    }
    const double cell = 1.0 / (levels * levels);
    EXPECT_NEAR(hypervolume_staircase_gpa_mpa(a), in_a * cell, 1e-12);
    EXPECT_NEAR(front_gap_gpa_mpa(a, b), in_either_alone * cell, 1e-12);
  }
}

TEST(Hypervolume, PolygonLiesBetweenTheStaircaseAndTheBoundingRectangle) {
  RandomStream random(7, "test");
  for (int trial = 0; trial < 20; ++trial) {
    const auto points = random_points(30, 0, random);
    const auto front = pareto_front(points);
    EXPECT_GE(hypervolume_polygon_gpa_mpa(points), hypervolume_staircase_gpa_mpa(points));
    EXPECT_LE(hypervolume_polygon_gpa_mpa(points),
              front.back().modulus_pa / kGpa * front.front().toughness_pa / kMpa + 1e-12);
  }
}

TEST(Gap, IsADistanceBetweenFronts) {
  RandomStream random(8, "test");
  for (int trial = 0; trial < 20; ++trial) {
    const auto a = random_points(10, 0, random), b = random_points(10, 0, random), c = random_points(10, 0, random);
    EXPECT_EQ(front_gap_gpa_mpa(a, a), 0.0);
    EXPECT_DOUBLE_EQ(front_gap_gpa_mpa(a, b), front_gap_gpa_mpa(b, a));
    EXPECT_LE(front_gap_gpa_mpa(a, c), front_gap_gpa_mpa(a, b) + front_gap_gpa_mpa(b, c) + 1e-12);
    EXPECT_DOUBLE_EQ(front_gap_gpa_mpa(a, {}), hypervolume_staircase_gpa_mpa(a));
    EXPECT_GE(front_gap_gpa_mpa(a, b),
              std::abs(hypervolume_staircase_gpa_mpa(a) - hypervolume_staircase_gpa_mpa(b)) - 1e-12);
  }
}

}  // namespace
}  // namespace nacre::optimize
