#include "pattern/random_pattern.hpp"

#include <array>
#include <set>

#include <gtest/gtest.h>

#include "pattern/constraints.hpp"

namespace nacre::pattern {
namespace {

TEST(RandomPattern, HasExactlyTheWantedPercentageAndIsFeasible) {
  RandomStream random(1, "test");
  for (int percent = 50; percent <= 85; ++percent) {
    for (int i = 0; i < 200; ++i) {
      const Pattern pattern = random_pattern(percent, random);
      ASSERT_EQ(pattern.rigid_count(), 4 * percent);
      ASSERT_EQ(violation(pattern), std::nullopt);
    }
  }
}

TEST(RandomPattern, EveryFreePixelIsSometimesSoftUnlessRequired) {
  RandomStream random(2, "test");
  std::uint64_t ever_soft = 0;
  for (int i = 0; i < 2000; ++i) ever_soft |= ~random_pattern(80, random).bits();
  EXPECT_EQ(ever_soft & kAllFreePixels, kAllFreePixels & ~required_rigid_bits(320));
}

bool is_bar(const Pattern& pattern, int row) {
  for (int column = 0; column < kQuarter; ++column)
    if (!pattern.rigid(row, column)) return false;
  return true;
}

TEST(RandomBarredPattern, HasBarsAndRectanglesBetweenThem) {
  RandomStream random(6, "test"), same(6, "test");
  std::set<Pattern> patterns;
  for (int i = 0; i < 500; ++i) {
    const Pattern pattern = random_barred_pattern(random);
    ASSERT_EQ(random_barred_pattern(same), pattern);
    ASSERT_EQ(violation(pattern), std::nullopt);
    int bars = 0;
    for (int row = 0; row < kQuarter; ++row) bars += is_bar(pattern, row);
    EXPECT_GE(bars, 3) << pattern.key();
    EXPECT_TRUE(is_bar(pattern, 0)) << pattern.key();
    for (int row = 1; row < kQuarter; ++row) {
      if (is_bar(pattern, row - 1) || is_bar(pattern, row)) continue;
      for (int column = 0; column < kQuarter; ++column)
        ASSERT_EQ(pattern.rigid(row, column), pattern.rigid(row - 1, column)) << pattern.key();
    }
    patterns.insert(pattern);
  }
  EXPECT_GT(patterns.size(), 300u);
}

TEST(StratifiedPatterns, TenSpreadThreeThreeTwoTwoOverTheIntervalsOfTable32) {
  RandomStream random(3, "test");
  const std::vector<Pattern> patterns = stratified_patterns(10, random);
  std::array<int, 4> counts{};
  for (const Pattern& pattern : patterns) {
    const int percent = pattern.rigid_count() / 4;
    ++counts[percent < 60 ? 0 : percent < 70 ? 1 : percent < 80 ? 2 : 3];
    EXPECT_EQ(violation(pattern), std::nullopt);
  }
  EXPECT_EQ(counts, (std::array<int, 4>{3, 3, 2, 2}));
}

TEST(StratifiedPatterns, AreDifferentAndReproducible) {
  RandomStream random(4, "test"), same(4, "test"), other(5, "test");
  const std::vector<Pattern> patterns = stratified_patterns(300, random);
  EXPECT_EQ(std::set<Pattern>(patterns.begin(), patterns.end()).size(), 300u);
  EXPECT_EQ(stratified_patterns(300, same), patterns);
  EXPECT_NE(stratified_patterns(300, other), patterns);
  EXPECT_TRUE(stratified_patterns(0, random).empty());
}

}  // namespace
}  // namespace nacre::pattern
