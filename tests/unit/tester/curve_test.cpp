#include "tester/curve.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace nacre::tester {
namespace {

const Curve kTriangle = {.strain = {0.0, 0.1, 0.2}, .stress_pa = {0.0, 10.0, 0.0}};
const Curve kLine = {.strain = {0.0, 0.2}, .stress_pa = {0.0, 10.0}};

TEST(Curve, AreaIsTheTrapezoidalRule) {
  EXPECT_NEAR(area_under(kTriangle), 1.0, 1e-15);
  EXPECT_EQ(area_under({}), 0.0);
}

TEST(Curve, UnloadingGivesItsWorkBack) {
  const Curve cycle = {.strain = {0.0, 0.1, 0.2, 0.1}, .stress_pa = {0.0, 10.0, 20.0, 10.0}};
  EXPECT_NEAR(area_under(cycle), area_under({.strain = {0.0, 0.1}, .stress_pa = {0.0, 10.0}}), 1e-15);
}

TEST(Curve, AreaBetweenACurveAndItselfIsZero) { EXPECT_EQ(area_between(kTriangle, kTriangle), 0.0); }

TEST(Curve, TheLargestDifferenceCountsOnlyWhatLiesBelowItsStrain) {
  Curve other = kTriangle;
  other.stress_pa.back() += 0.1 * *std::max_element(kTriangle.stress_pa.begin(), kTriangle.stress_pa.end());
  EXPECT_EQ(largest_difference(kTriangle, kTriangle, 1.0), 0.0);
  EXPECT_NEAR(largest_difference(kTriangle, other, kTriangle.strain.back()), 0.1, 1e-12);
  EXPECT_EQ(largest_difference(kTriangle, other, 0.5 * kTriangle.strain.back()), 0.0);
  EXPECT_EQ(largest_difference({}, {}, 1.0), 1.0);
}

TEST(Curve, AreaBetweenIsSymmetricAndCountsCrossings) {
  // Triangle above the line up to strain 2/15, below it after: |difference| has two triangles.
  const double crossing = 2.0 / 15.0;
  const double above = 0.5 * crossing * 5.0, below = 0.5 * (0.2 - crossing) * 10.0;
  EXPECT_NEAR(area_between(kTriangle, kLine), above + below, 1e-14);
  EXPECT_NEAR(area_between(kLine, kTriangle), above + below, 1e-14);
}

TEST(Curve, BeyondItsEndACurveIsZero) {
  const Curve brief = {.strain = {0.0, 0.1}, .stress_pa = {0.0, 10.0}};
  // They agree up to 0.1; the line's remainder counts in full, the jump at the end adds nothing of its own.
  const Curve line = {.strain = {0.0, 0.2}, .stress_pa = {0.0, 20.0}};
  EXPECT_NEAR(area_between(brief, line), 0.1 * 15.0, 1e-14);
  EXPECT_NEAR(area_between({}, line), area_under(line), 1e-14);
}

TEST(Curve, AreaBetweenIsAtLeastTheDifferenceOfTheAreas) {
  EXPECT_GE(area_between(kTriangle, kLine), std::abs(area_under(kTriangle) - area_under(kLine)));
}

TEST(Curve, AreaBetweenAllowsRepeatedStrains) {
  const Curve drop = {.strain = {0.0, 0.1, 0.1, 0.2}, .stress_pa = {0.0, 10.0, 4.0, 4.0}};
  EXPECT_NEAR(area_between(drop, {}), area_under(drop), 1e-14);
}

TEST(Curve, StressIsInterpolatedAndZeroOutside) {
  EXPECT_NEAR(stress_at(kTriangle, 0.05), 5.0, 1e-14);
  EXPECT_NEAR(stress_at(kTriangle, 0.1), 10.0, 1e-14);
  EXPECT_NEAR(stress_at(kLine, 0.2), 10.0, 1e-14);
  EXPECT_EQ(stress_at(kTriangle, -0.01), 0.0);
  EXPECT_EQ(stress_at(kTriangle, 0.21), 0.0);
  EXPECT_EQ(stress_at({}, 0.0), 0.0);
}

TEST(Curve, ResamplingKeepsTheAreaAndTheEnds) {
  Curve bumpy;
  for (int i = 0; i <= 1000; ++i) {
    bumpy.strain.push_back(0.01 + 1e-4 * i);
    bumpy.stress_pa.push_back(std::sin(0.01 * i) + 0.3 * std::sin(i));
  }
  for (const int points : {5, 20, 200, 3000}) {
    const Curve curve = resampled(bumpy, points);
    ASSERT_EQ(curve.size(), static_cast<std::size_t>(points));
    EXPECT_EQ(curve.strain.front(), bumpy.strain.front());
    EXPECT_EQ(curve.strain.back(), bumpy.strain.back());
    EXPECT_NEAR(area_under(curve), area_under(bumpy), 1e-12);
  }
}

}  // namespace
}  // namespace nacre::tester
