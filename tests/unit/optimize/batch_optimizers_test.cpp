// What every optimiser behind the seam promises, and how far each gets on functions with known minima.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/result.hpp"
#include "optimize/batch_optimizer.hpp"
#include "optimize/sobol.hpp"

namespace nacre::optimize {
namespace {

constexpr Algorithm kAll[] = {Algorithm::bayesian, Algorithm::trust_region, Algorithm::random,
                              Algorithm::direct_l, Algorithm::crs2,         Algorithm::cma_es};

/// A bowl with its minimum 0 at (0.3, 0.7, 0.3, ...), a hundred times as steep in the first coordinate.
double bowl(const Point& point) {
  double sum = 0.0;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const double apart = point[k] - (k % 2 == 0 ? 0.3 : 0.7);
    sum += (k == 0 ? 10.0 : 0.1) * apart * apart;
  }
  return sum;
}

BatchOptimizerSettings settings(int dimension, int budget) {
  BatchOptimizerSettings result;
  result.dimension = dimension;
  result.budget = budget;
  return result;
}

/// Runs up to `evaluations` of them; returns everything told.
std::vector<Evaluation> run(BatchOptimizer& optimizer, int evaluations, int fail_every = 0) {
  std::vector<Evaluation> told;
  while (static_cast<int>(told.size()) < evaluations) {
    const std::vector<Point> points = optimizer.ask();
    if (points.empty()) break;
    std::vector<std::optional<double>> values;
    for (const Point& point : points) {
      const bool fails = fail_every > 0 && told.size() % static_cast<std::size_t>(fail_every) == 1;
      values.push_back(fails ? std::nullopt : std::optional(bowl(point)));
      told.push_back({point, values.back()});
    }
    optimizer.tell(values);
  }
  return told;
}

class EveryAlgorithm : public testing::TestWithParam<Algorithm> {};

TEST_P(EveryAlgorithm, SpendsItsBudgetInsideTheCubeInBatches) {
  const auto optimizer = make_optimizer(GetParam(), settings(3, 32));
  int count = 0;
  for (std::vector<Point> points = optimizer->ask(); !points.empty(); points = optimizer->ask()) {
    EXPECT_LE(points.size(), 3u);
    std::vector<std::optional<double>> values;
    for (const Point& point : points) {
      ASSERT_EQ(point.size(), 3u);
      for (const double coordinate : point) {
        EXPECT_GE(coordinate, 0.0);
        EXPECT_LE(coordinate, 1.0);
      }
      values.push_back(bowl(point));
    }
    count += static_cast<int>(points.size());
    optimizer->tell(values);
  }
  EXPECT_EQ(count, 32);
}

TEST_P(EveryAlgorithm, AsksForTheStartsFirst) {
  BatchOptimizerSettings with_starts = settings(2, 20);
  with_starts.starts = {{0.9, 0.1}, {0.2, 0.2}};
  const std::vector<Point> points = make_optimizer(GetParam(), with_starts)->ask();
  ASSERT_GE(points.size(), 2u);
  EXPECT_EQ(points[0], with_starts.starts[0]);
  EXPECT_EQ(points[1], with_starts.starts[1]);
}

TEST_P(EveryAlgorithm, ResumesAsIfItHadNeverStopped) {
  const auto whole = make_optimizer(GetParam(), settings(3, 36));
  const std::vector<Evaluation> expected = run(*whole, 36);
  const auto first = make_optimizer(GetParam(), settings(3, 36));
  const std::vector<Evaluation> part = run(*first, 18);
  const auto second = make_optimizer(GetParam(), settings(3, 36));
  second->resume(part);
  const std::vector<Evaluation> rest = run(*second, 18);
  ASSERT_EQ(part.size() + rest.size(), expected.size());
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_EQ(rest[i].point, expected[part.size() + i].point) << i;
  EXPECT_EQ(second->best()->value, whole->best()->value);
}

TEST_P(EveryAlgorithm, ResumesThroughFailures) {
  const auto whole = make_optimizer(GetParam(), settings(3, 60));
  std::vector<Evaluation> told;
  for (int step = 0; step < 20; ++step) {
    const auto resumed = make_optimizer(GetParam(), settings(3, 60));
    resumed->resume(told);
    const std::vector<Point> points = whole->ask();
    ASSERT_EQ(resumed->ask(), points) << "after " << told.size() << " evaluations";
    std::vector<std::optional<double>> values;
    for (const Point& point : points) {
      // Failures, and worse values after them, which move what a failure counts as.
      const bool fails = told.size() % 4 == 1;
      values.push_back(fails ? std::nullopt : std::optional(bowl(point) * (1.0 + static_cast<double>(told.size()))));
      told.push_back({point, values.back()});
    }
    whole->tell(values);
  }
}

TEST_P(EveryAlgorithm, SurvivesFailures) {
  const auto optimizer = make_optimizer(GetParam(), settings(3, 40));
  const std::vector<Evaluation> told = run(*optimizer, 40, 4);
  EXPECT_GE(told.size(), 36u);
  EXPECT_LT(*optimizer->best()->value, 1.0);
}

TEST_P(EveryAlgorithm, RefusesNonsense) {
  EXPECT_THROW(make_optimizer(GetParam(), settings(0, 10)), InputError);
  BatchOptimizerSettings wrong = settings(3, 10);
  wrong.starts = {{0.5, 0.5}};
  EXPECT_THROW(make_optimizer(GetParam(), wrong), InputError);
}

TEST_P(EveryAlgorithm, IsFoundUnderItsName) {
  EXPECT_EQ(algorithm_from_string(to_string(GetParam())).value(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Optimizers, EveryAlgorithm, testing::ValuesIn(kAll),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST(BayesianOptimizer, BeatsRandomSearchByFarOnASmoothBowl) {
  const auto bayesian = make_optimizer(Algorithm::bayesian, settings(4, 45));
  const auto random = make_optimizer(Algorithm::random, settings(4, 45));
  run(*bayesian, 45);
  run(*random, 45);
  EXPECT_LT(*bayesian->best()->value, 0.005);
  EXPECT_LT(*bayesian->best()->value, 0.1 * *random->best()->value);
}

TEST(BayesianOptimizer, BatchesOfAnySizeHoldDistinctPoints) {
  BatchOptimizerSettings wide = settings(3, 60);
  wide.batch = 8;
  const auto optimizer = make_optimizer(Algorithm::bayesian, wide);
  std::set<Point> seen;
  for (const Evaluation& evaluation : run(*optimizer, 60)) EXPECT_TRUE(seen.insert(evaluation.point).second);
  EXPECT_EQ(seen.size(), 60u);
}

TEST(BayesianOptimizer, RefusesAHistoryOfOtherDimensions) {
  const auto optimizer = make_optimizer(Algorithm::bayesian, settings(3, 20));
  EXPECT_THROW(optimizer->resume({{{0.5, 0.5}, 1.0}}), InputError);
}

TEST(Resume, RefusesTheHistoryOfAnotherSearch) {
  BatchOptimizerSettings other = settings(3, 20);
  other.seed = 2;
  for (const Algorithm algorithm : {Algorithm::random, Algorithm::bayesian}) {
    const std::vector<Evaluation> told = run(*make_optimizer(algorithm, other), 9);
    EXPECT_THROW(make_optimizer(algorithm, settings(3, 20))->resume(told), InputError) << to_string(algorithm);
  }
}

TEST(Resume, RefusesTheHistoryOfOtherStarts) {
  BatchOptimizerSettings other = settings(3, 20);
  other.starts = {{0.1, 0.2, 0.3}};
  const std::vector<Evaluation> told = run(*make_optimizer(Algorithm::bayesian, other), 9);
  EXPECT_THROW(make_optimizer(Algorithm::bayesian, settings(3, 20))->resume(told), InputError);
}

TEST(CmaEs, BeginsAtTheBestGuessThoughTheBatchIsLarger) {
  BatchOptimizerSettings large = settings(3, 60);
  large.batch = 12;
  large.starts = {{0.95, 0.95, 0.95}};
  const std::vector<Point> points = make_optimizer(Algorithm::cma_es, large)->ask();
  double mean = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) mean += points[i][0] / static_cast<double>(points.size() - 1);
  EXPECT_GT(mean, 0.7) << "the middle of the cube is 0.5";
}

TEST(CmaEs, ConvergesOnARotatedIllConditionedBowl) {
  const auto rotated = [](const Point& p) {
    const double u = p[0] + p[1] - 1.0, v = p[0] - p[1] + 0.2;
    return 1000.0 * u * u + v * v;
  };
  const auto optimizer = make_optimizer(Algorithm::cma_es, settings(2, 600));
  for (std::vector<Point> points = optimizer->ask(); !points.empty(); points = optimizer->ask()) {
    std::vector<std::optional<double>> values;
    for (const Point& point : points) values.push_back(rotated(point));
    optimizer->tell(values);
  }
  EXPECT_LT(*optimizer->best()->value, 1e-6);
}

TEST(SobolPoints, EverySliceOfEveryAxisGetsOnePoint) {
  constexpr int kCount = 256;
  SobolPoints points(SobolPoints::kMostDimensions, 5);
  std::vector<std::set<int>> slices(SobolPoints::kMostDimensions);
  for (int i = 0; i < kCount; ++i) {
    const Point point = points.next();
    for (std::size_t k = 0; k < point.size(); ++k) slices[k].insert(static_cast<int>(point[k] * kCount));
  }
  for (const std::set<int>& slice : slices) EXPECT_EQ(slice.size(), static_cast<std::size_t>(kCount));
}

// The first two coordinates are a (0, m, 2)-net: every elementary rectangle of area 2^-m holds exactly one of 2^m
// points.
TEST(SobolPoints, TheFirstTwoAxesFormANet) {
  for (int a = 0; a <= 6; ++a) {
    SobolPoints points(2, 9);
    std::set<std::pair<int, int>> cells;
    for (int i = 0; i < 64; ++i) {
      const Point point = points.next();
      cells.insert({static_cast<int>(point[0] * (1 << a)), static_cast<int>(point[1] * (1 << (6 - a)))});
    }
    EXPECT_EQ(cells.size(), 64u) << a;
  }
}

TEST(SobolPoints, RefusesDimensionsWithoutATable) {
  EXPECT_THROW(SobolPoints(17, 1), InputError);
  EXPECT_THROW(SobolPoints(0, 1), InputError);
}

}  // namespace
}  // namespace nacre::optimize
