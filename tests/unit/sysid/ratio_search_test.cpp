#include "sysid/ratio_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace nacre::sysid {
namespace {

/// Runs a search on f(x) / target and returns the number of evaluations.
int run(RatioSearch& search, const std::function<std::optional<double>(double)>& ratio, int batch, int most = 60) {
  int evaluations = 0;
  while (evaluations < most) {
    const std::vector<double> points = search.ask(batch);
    if (points.empty()) break;
    for (const double x : points) search.tell(x, ratio(x));
    evaluations += static_cast<int>(points.size());
  }
  return evaluations;
}

TEST(RatioSearch, ProportionalFunctionIsSolvedInTwoSteps) {
  RatioSearch search({.lower = 1e4, .upper = 1e8, .first = 1e6, .tolerance = 1e-9});
  EXPECT_LE(run(
                search, [](double x) { return x / 3.3e7; }, 1),
            2);
  EXPECT_TRUE(search.met());
  EXPECT_NEAR(search.best().value(), 3.3e7, 1.0);
}

TEST(RatioSearch, CurvedFunctionIsSolvedInAnyBatchSize) {
  const auto ratio = [](double x) { return std::pow(x / 2e5, 0.6) * (1.0 + 0.3 * std::sin(std::log(x))); };
  for (const int batch : {1, 2, 3, 5}) {
    RatioSearch search({.lower = 1e4, .upper = 1e8, .first = 5e6, .tolerance = 1e-4});
    EXPECT_LE(run(search, ratio, batch), 24) << batch;
    ASSERT_TRUE(search.met()) << batch;
    EXPECT_NEAR(ratio(*search.best()), 1.0, 1e-4);
  }
}

TEST(RatioSearch, EndsAtTheBoundWhenTheTargetLiesBeyond) {
  RatioSearch search({.lower = 1.0, .upper = 10.0, .first = 2.0, .tolerance = 1e-3});
  EXPECT_LE(run(
                search, [](double x) { return x / 100.0; }, 3),
            12);
  EXPECT_FALSE(search.met());
  EXPECT_NEAR(search.best().value(), 10.0, 1e-9);
}

TEST(RatioSearch, EndsAtAJumpAcrossTheTarget) {
  RatioSearch search({.lower = 1.0, .upper = 10.0, .first = 2.0, .tolerance = 1e-3});
  EXPECT_LT(run(
                search, [](double x) { return x < 5.0 ? 0.9 : 1.2; }, 2),
            60);
  EXPECT_FALSE(search.met());
  EXPECT_LT(search.best().value(), 5.0);  // 0.9 is nearer than 1.2
}

TEST(RatioSearch, FailuresAreNotAskedAgain) {
  RatioSearch search({.lower = 1.0, .upper = 1e6, .first = 10.0, .tolerance = 1e-3});
  std::vector<double> asked;
  run(
      search,
      [&](double x) -> std::optional<double> {
        for (const double before : asked) EXPECT_NE(before, x);
        asked.push_back(x);
        return x < 12.0 ? std::nullopt : std::optional(x / 300.0);
      },
      3);
  EXPECT_TRUE(search.met());
}

}  // namespace
}  // namespace nacre::sysid
