#include "explore/improvement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace nacre::explore {
namespace {

using optimize::Performance;

constexpr double kUnits = 1e15;  // Pa^2 per GPa MPa

std::vector<Performance> some_front() {
  return optimize::pareto_front(
      std::vector<Performance>{{0.2e9, 0.5e6}, {0.6e9, 0.4e6}, {1.1e9, 0.25e6}, {1.5e9, 0.1e6}});
}

double growth(std::vector<Performance> front, const Performance& point) {
  const double before = optimize::hypervolume_staircase_gpa_mpa(front);
  front.push_back(point);
  return optimize::hypervolume_staircase_gpa_mpa(front) - before;
}

TEST(LogNormal, ExcessIsTheMeanOfDraws) {
  RandomStream random(1, "test");
  const LogNormal belief{std::log(2.0), 0.4};
  for (const double threshold : {0.0, 1.0, 2.0, 4.0}) {
    double sum = 0.0;
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) sum += std::max(0.0, 2.0 * std::exp(0.4 * random.normal()) - threshold);
    EXPECT_NEAR(belief.expected_excess(threshold), sum / kDraws, 0.015);
  }
}

TEST(ExpectedImprovement, OfACertainPointIsItsGrowthOfTheHypervolume) {
  RandomStream random(2, "test");
  for (int i = 0; i < 50; ++i) {
    const Performance point{random.uniform(0.1e9, 2e9), random.uniform(0.05e6, 0.7e6)};
    const Belief belief{{std::log(point.modulus_pa), 0.0}, {std::log(point.toughness_pa), 0.0}};
    EXPECT_NEAR(expected_improvement(belief, some_front()) / kUnits, growth(some_front(), point), 1e-9);
  }
  const Belief belief{{std::log(1e9), 0.0}, {std::log(1e6), 0.0}};
  EXPECT_NEAR(expected_improvement(belief, {}) / kUnits, 1.0, 1e-9) << "without a front: the whole rectangle";
}

TEST(ExpectedImprovement, IsTheMeanGrowthOfDraws) {
  RandomStream random(3, "test");
  const Belief belief{{std::log(0.9e9), 0.2}, {std::log(0.3e6), 0.3}};
  double sum = 0.0;
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    sum += growth(some_front(), {0.9e9 * std::exp(0.2 * random.normal()), 0.3e6 * std::exp(0.3 * random.normal())});
  }
  EXPECT_NEAR(expected_improvement(belief, some_front()) / kUnits, sum / kDraws, 0.02 * sum / kDraws);
}

TEST(ExpectedImprovement, ANoisyTestSettlesAPartAndKeepsTheMean) {
  const auto mean_of = [](const LogNormal& belief) { return belief.expected_excess(0.0); };
  Belief belief{{std::log(1e9), 0.0}, {std::log(0.3e6), 0.2}};
  const double sure = expected_improvement(belief, some_front());
  EXPECT_EQ(belief.toughness_ahead().log_deviation, 0.2);
  belief.noise_variance = 0.04;
  EXPECT_NEAR(belief.toughness_ahead().log_deviation, 0.2 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(mean_of(belief.toughness_ahead()), mean_of(belief.toughness), 1e-6 * mean_of(belief.toughness));
  EXPECT_LT(expected_improvement(belief, some_front()), sure);
}

TEST(ExpectedRegrowth, IsTheMeanGrowthOfThePosteriorMeansFront) {
  RandomStream random(7, "test");
  std::vector<Performance> points = some_front();
  points.push_back({0.55e9, 0.38e6});  // behind the second, and next in line
  Belief belief{{std::log(0.6e9), 0.0}, {std::log(0.4e6) - 0.02, 0.2}, 0.03, points[1]};
  std::vector<Performance> others = points;
  others.erase(others.begin() + 1);
  const LogNormal ahead = belief.toughness_ahead();
  double sum = 0.0;
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i)
    sum += growth(others, {0.6e9, std::exp(ahead.log_mean + ahead.log_deviation * random.normal())});
  const double expected = sum / kDraws - growth(others, points[1]);
  EXPECT_NEAR(expected_regrowth(belief, points) / kUnits, expected, 0.03 * expected);
  belief.toughness = {std::log(0.4e6) - 0.5e-6, 1e-3};
  EXPECT_NEAR(expected_regrowth(belief, points) / kUnits, 0.0, 1e-6) << "one that no rival comes near is tested enough";
}

TEST(BestImprovements, AreChosenOneByOneAsIfTheFormerCameTrue) {
  RandomStream random(4, "test");
  std::vector<Belief> beliefs;
  for (int i = 0; i < 60; ++i) {
    beliefs.push_back({{std::log(random.uniform(0.2e9, 1.6e9)), random.uniform(0.0, 0.2)},
                       {std::log(random.uniform(0.1e6, 0.6e6)), random.uniform(0.0, 0.3)}});
  }
  const auto chosen = best_improvements(beliefs, some_front(), 8);
  ASSERT_EQ(chosen.size(), 8u);
  std::vector<Performance> front = some_front();
  std::vector<std::size_t> before;
  for (const std::size_t each : chosen) {
    for (std::size_t other = 0; other < beliefs.size(); ++other) {
      if (std::find(before.begin(), before.end(), other) != before.end()) continue;
      EXPECT_GE(expected_improvement(beliefs[each], front), expected_improvement(beliefs[other], front));
    }
    before.push_back(each);
    front.push_back(beliefs[each].median());
    front = optimize::pareto_front(front);
  }
  EXPECT_EQ(best_improvements({beliefs.begin(), beliefs.begin() + 3}, {}, 8).size(), 3u);
}

TEST(BestImprovements, APatternCorrelatedWithTheChosenOneIsNotTheNext) {
  // Three equally promising patterns; the first two err together, the third by itself.
  const Belief belief{{std::log(0.9e9), 0.05}, {std::log(0.36e6), 0.3}};
  const std::vector<Belief> beliefs = {belief, belief, belief};
  Eigen::MatrixXd modulus = 0.0025 * Eigen::MatrixXd::Identity(3, 3),
                  toughness = 0.09 * Eigen::MatrixXd::Identity(3, 3);
  modulus(0, 1) = modulus(1, 0) = 0.0025;
  toughness(0, 1) = toughness(1, 0) = 0.09;
  EXPECT_EQ(best_improvements(beliefs, some_front(), 2, {modulus, toughness}), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(best_improvements(beliefs, some_front(), 2), (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace nacre::explore
