#include "pattern/constraints.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::pattern {
namespace {

using ::testing::HasSubstr;

Pattern pattern_of(const char* key) { return Pattern::from_layout(layout_from_key(key).value()).value(); }

/// The rules of thesis 2.1 written out over all 400 pixels, with nothing shared with the implementation.
bool feasible_by_the_book(const Layout& layout) {
  const double fraction = layout.rigid_fraction();
  if (fraction < 0.50 || fraction > 0.85) return false;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const double y = std::min(r + 0.5, kSide - r - 0.5), x = std::min(c + 0.5, kSide - c - 0.5);
      const bool corner = y < 1 && x < 1;
      const bool near_corner = std::hypot(x, y) <= 4.0;
      if ((corner || (fraction >= 0.80 && near_corner)) && !layout.rigid(r, c)) return false;
    }
  }
  return true;
}

TEST(Constraints, AgreeWithTheRulesWrittenOutPixelByPixel) {
  RandomStream random(1, "test");
  int feasible = 0;
  for (int i = 0; i < 3000; ++i) {
    // Around every limit: a feasible pattern with one to three free pixels changed.
    Pattern pattern = random_pattern(random);
    for (int flips = random.index(3); flips >= 0; --flips) {
      pattern = Pattern(pattern.bits() ^ std::uint64_t{1} << random.index(kFreePixels));
    }
    EXPECT_EQ(is_feasible(pattern), feasible_by_the_book(pattern.layout())) << pattern.key();
    EXPECT_EQ(violation(pattern).has_value(), !is_feasible(pattern)) << pattern.key();
    feasible += is_feasible(pattern);
  }
  EXPECT_GT(feasible, 300);
  EXPECT_LT(feasible, 2700);
}

TEST(Constraints, LimitsOfTheRigidFractionAreIncluded) {
  RandomStream random(2, "test");
  for (const int percent : {50, 85}) EXPECT_FALSE(violation(random_pattern(percent, random)));
  EXPECT_EQ(violations(Pattern()).size(), 2u);  // too soft, and so is the corner
  EXPECT_THAT(violation(Pattern()).value(), HasSubstr("0 % of the pixels are rigid, fewer than the 50 % required"));
  EXPECT_THAT(violation(pattern_of("7fffffffffffff")).value(),
              HasSubstr("100 % of the pixels are rigid, more than the 85 %"));
}

TEST(Constraints, ExactlyEightyPercentFallsUnderTheWiderCornerRule) {
  RandomStream random(3, "test");
  const Pattern pattern = random_pattern(80, random);
  ASSERT_EQ(pattern.rigid_count(), 320);
  // Move a corner-region pixel elsewhere, the count unchanged.
  Pattern moved = pattern;
  moved.set(0, 2, false);
  for (int r = 0, done = 0; r < kQuarter && !done; ++r) {
    for (int c = r + 1; c < kQuarter && !done; ++c) {
      if (!moved.rigid(r, c) && (r != 0 || c != 2)) moved.set(r, c, true), done = 1;
    }
  }
  ASSERT_EQ(moved.rigid_count(), 320);
  EXPECT_THAT(violation(moved).value(), HasSubstr("with 80 % rigid pixels every pixel within 4 pixels of a corner"));
}

TEST(Constraints, TheCornerRegionHasThirteenPixels) {
  EXPECT_EQ(Pattern(required_rigid_bits(320)).rigid_count(), 4 * 13);
  EXPECT_EQ(Pattern(required_rigid_bits(319)).rigid_count(), 4);
}

TEST(Constraints, ASoftCornerIsNamed) {
  RandomStream random(4, "test");
  Pattern pattern = random_pattern(70, random);
  pattern.set(0, 0, false);
  EXPECT_THAT(violation(pattern).value(), HasSubstr("the corner pixel is soft"));
}

TEST(Constraints, BothPublishedPatternsLieInTheDesignSpace) {
  EXPECT_EQ(violation(pattern_of("577fffe9fffdef")), std::nullopt);  // 84 %
  EXPECT_EQ(violation(pattern_of("3ffc9b4ad4d2d9")), std::nullopt);  // 61 %
}

}  // namespace
}  // namespace nacre::pattern
