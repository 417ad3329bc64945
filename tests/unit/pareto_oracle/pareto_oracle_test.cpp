// Non-dominated sorting and hypervolume against pagmo2, which minimises: both objectives change their sign.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>

#include "base/random.hpp"
#include "optimize/pareto.hpp"

namespace nacre::optimize {
namespace {

constexpr double kGpa = 1e9, kMpa = 1e6;

/// Random points; `levels` > 0 draws from a coarse grid, so that ties abound.
std::vector<Performance> drawn(int count, int levels, std::uint64_t seed) {
  RandomStream random(seed, "oracle");
  const auto draw = [&] { return levels > 0 ? (1.0 + random.index(levels)) / levels : random.uniform(0.01, 1.0); };
  std::vector<Performance> points;
  for (int i = 0; i < count; ++i) {
    const double modulus = draw();
    points.push_back({modulus * kGpa, draw() * kMpa});
  }
  return points;
}

std::vector<pagmo::vector_double> minimised(const std::vector<Performance>& points) {
  std::vector<pagmo::vector_double> result;
  for (const Performance& point : points) result.push_back({-point.modulus_pa / kGpa, -point.toughness_pa / kMpa});
  return result;
}

TEST(ParetoOracle, RanksAreThoseOfPagmo) {
  for (const int levels : {0, 3, 12}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto points = drawn(300, levels, seed);
      const auto expected = std::get<3>(pagmo::fast_non_dominated_sorting(minimised(points)));
      const std::vector<int> ranks = non_dominated_ranks(points);
      for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(ranks[i], static_cast<int>(expected[i]) + 1);
    }
  }
}

TEST(ParetoOracle, HypervolumeIsThatOfPagmo) {
  for (const int levels : {0, 5, 40}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto points = drawn(200, levels, seed);
      const double expected = pagmo::hypervolume(minimised(points)).compute({0.0, 0.0});
      EXPECT_NEAR(hypervolume_staircase_gpa_mpa(points), expected, 1e-12);
    }
  }
}

TEST(ParetoOracle, CrowdingIsThatOfPagmoWithinARank) {
  const auto points = drawn(200, 0, 7);
  const std::vector<int> ranks = non_dominated_ranks(points);
  const auto crowding = crowding_distances(points, ranks);
  std::vector<std::size_t> first;
  std::vector<Performance> front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (ranks[i] == 2) first.push_back(i), front.push_back(points[i]);
  }
  ASSERT_GT(front.size(), 3u);
  const auto expected = pagmo::crowding_distance(minimised(front));
  for (std::size_t k = 0; k < first.size(); ++k) {
    if (expected[k] == std::numeric_limits<double>::infinity()) {
      EXPECT_EQ(crowding[first[k]], expected[k]);
    } else {
      EXPECT_NEAR(crowding[first[k]], expected[k], 1e-9);
    }
  }
}

}  // namespace
}  // namespace nacre::optimize
