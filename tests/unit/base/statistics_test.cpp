#include "base/statistics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(Statistics, RankCorrelationFeelsOnlyTheOrder) {
  const std::vector<double> a = {1.0, 2.0, 3.0, 4.0}, cubes = {1.0, 8.0, 27.0, 64.0}, falling = {4.0, 3.0, 2.0, 1.0};
  EXPECT_DOUBLE_EQ(rank_correlation(a, cubes), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation(a, falling), -1.0);
}

TEST(Statistics, TiesShareTheirRankInTheCorrelation) {
  // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 / sqrt(4.5 * 5).
  const std::vector<double> tied = {1.0, 2.0, 2.0, 3.0}, distinct = {1.0, 2.0, 3.0, 4.0};
  EXPECT_NEAR(rank_correlation(tied, distinct), 4.5 / std::sqrt(4.5 * 5.0), 1e-15);
}

TEST(Statistics, AConstantSideCorrelatesWithNothing) {
  const std::vector<double> constant = {2.0, 2.0, 2.0}, a = {1.0, 2.0, 3.0};
  EXPECT_EQ(rank_correlation(constant, a), 0.0);
}

TEST(Statistics, SpreadIsAboutTheMeanAndRootMeanSquareAboutZero) {
  const std::vector<double> values = {1.0, 3.0};
  EXPECT_DOUBLE_EQ(mean(values), 2.0);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(root_mean_square(values), std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(root_mean_square(values, 1), std::sqrt(10.0));
}

TEST(Statistics, QuantilesRunFromTheLeastToTheGreatest) {
  const std::vector<double> values = {3.0, 1.0, 2.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.5);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 3.0);
}

TEST(Statistics, TheNormalDistributionIsTheTables) {
  EXPECT_DOUBLE_EQ(normal_cdf(0.0), 0.5);
  EXPECT_NEAR(normal_cdf(1.959964), 0.975, 1e-7);
  EXPECT_NEAR(normal_cdf(-6.0) / 9.865876e-10, 1.0, 1e-6);
}

TEST(Statistics, StudentsChanceIsThatOfTheTables) {
  EXPECT_NEAR(student_beyond(12.706, 1), 0.05, 1e-5);
  EXPECT_NEAR(student_beyond(-9.925, 2), 0.01, 1e-5);
  EXPECT_NEAR(student_beyond(5.841, 3), 0.01, 1e-5);
  EXPECT_NEAR(student_beyond(2.228, 10), 0.05, 1e-4);
  EXPECT_NEAR(student_beyond(2.0, 100000), 2.0 * normal_cdf(-2.0), 1e-5);
  EXPECT_EQ(student_beyond(0.0, 5), 1.0);
  EXPECT_NEAR(student_quantile(0.10, 2), 2.920, 1e-3);
}

}  // namespace
}  // namespace nacre
