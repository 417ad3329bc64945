#include "pattern/mutation.hpp"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pattern/constraints.hpp"
#include "pattern/random_pattern.hpp"
#include "thesis/constants.hpp"

namespace nacre::pattern {
namespace {

TEST(Mutation, RepairedMutantsLieInTheDesignSpace) {
  RandomStream random(1, "test");
  for (const auto kind : {MutationKind::three_way, MutationKind::single_pixel}) {
    for (int i = 0; i < 20000; ++i) {
      const Pattern child = mutate(random_pattern(random), kind, random);
      ASSERT_TRUE(is_feasible(child)) << child.key() << ": " << violation(child).value_or("");
    }
  }
}

TEST(Mutation, ASinglePixelAttemptChangesOneOrbit) {
  RandomStream random(2, "test");
  int diagonal = 0;
  constexpr int kTrials = 20000;
  for (int i = 0; i < kTrials; ++i) {
    const Pattern parent = random_pattern(random);
    const std::uint64_t change = parent.bits() ^ mutation_attempt(parent, MutationKind::single_pixel, random).bits();
    ASSERT_EQ(std::popcount(change), 1);
    diagonal += Pattern::orbit_size(std::countr_zero(change)) == 4;
  }
  // 40 of the 400 pixels lie on a diagonal: binomial, 5 standard deviations.
  EXPECT_NEAR(diagonal, 0.1 * kTrials, 5 * std::sqrt(kTrials * 0.1 * 0.9));
}

TEST(Mutation, LinesAndSquaresMakeUpAboutTheirShareOfTheAttempts) {
  RandomStream random(3, "test");
  int larger = 0, none = 0;
  constexpr int kTrials = 20000;
  for (int i = 0; i < kTrials; ++i) {
    const Pattern parent = random_pattern(65, random);
    const int changed = std::popcount(parent.bits() ^ mutation_attempt(parent, MutationKind::three_way, random).bits());
    larger += changed > 1;
    none += changed == 0;
  }
  EXPECT_LT(larger + none, (thesis::kLineMutation + thesis::kSquareMutation) * kTrials * 1.1);
  EXPECT_GT(larger, 0.09 * kTrials);
  EXPECT_GT(none, 0);  // a line over pixels that had its value already
}

/// Whether the rigid pixels of the quarter hang together, diagonal neighbours included.
bool quarter_is_connected(const Pattern& pattern) {
  std::vector<std::pair<int, int>> rest, frontier;
  for (int r = 0; r < kQuarter; ++r) {
    for (int c = 0; c < kQuarter; ++c) {
      if (pattern.rigid(r, c) && c >= r) rest.emplace_back(r, c);
    }
  }
  frontier.push_back(rest.back()), rest.pop_back();
  while (!frontier.empty()) {
    const auto at = frontier.back();
    frontier.pop_back();
    for (std::size_t i = rest.size(); i-- > 0;) {
      if (std::abs(rest[i].first - at.first) > 1 || std::abs(rest[i].second - at.second) > 1) continue;
      frontier.push_back(rest[i]);
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return rest.empty();
}

TEST(Mutation, LinesAndSquaresHangTogetherWhenFoldedIntoTheQuarter) {
  // Folding the unit onto its quarter is continuous, so an unbroken line stays unbroken.
  RandomStream random(4, "test");
  int larger = 0;
  for (int i = 0; i < 5000; ++i) {
    const Pattern child = mutation_attempt(Pattern(), MutationKind::three_way, random);
    if (std::popcount(child.bits()) < 2) continue;
    ++larger;
    ASSERT_TRUE(quarter_is_connected(child)) << to_text(child.layout());
  }
  EXPECT_GT(larger, 200);
}

TEST(Mutation, MostlySoftPatternsAreFlippedWithRigidCorners) {
  RandomStream random(5, "test");
  int flips = 0;
  for (int i = 0; i < 100; ++i) {
    Pattern pattern = random_pattern(50, random);
    EXPECT_EQ(flipped_if_mostly_soft(pattern), pattern);
    pattern.set(4, 7, false), pattern.set(2, 5, false), pattern.set(6, 6, false);
    if (pattern.rigid_count() >= kMinimumRigidCount) continue;  // all three were soft already
    ++flips;
    const Pattern flipped = flipped_if_mostly_soft(pattern);
    for (int r = 0; r < kQuarter; ++r) {
      for (int c = r; c < kQuarter; ++c) {
        EXPECT_EQ(flipped.rigid(r, c), r + c == 0 ? true : !pattern.rigid(r, c));
      }
    }
  }
  EXPECT_GT(flips, 50);
}

TEST(Mutation, RollingBackStaysWithinOneAttemptOfTheParent) {
  RandomStream random(6, "test");
  int kept = 0, rolled_back = 0;
  for (int i = 0; i < 5000; ++i) {
    const Pattern parent = random_pattern(55 + random.index(31), random);
    const auto child = mutate_or_roll_back(parent, MutationKind::single_pixel, random);
    if (!child) {
      ++rolled_back;
      continue;
    }
    ++kept;
    ASSERT_TRUE(is_feasible(*child));
    ASSERT_EQ(std::popcount(child->bits() ^ parent.bits()), 1);  // above 52 % no single pixel brings the flip about
  }
  EXPECT_GT(kept, 1000);
  EXPECT_GT(rolled_back, 100);
}

TEST(Mutation, RepairReachesPatternsThatRollingBackCannot) {
  // At exactly 85 % a rigid pixel must go before a soft one can come: repair may do both in one mutation.
  RandomStream random(7, "test");
  int far = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pattern parent = random_pattern(85, random);
    far += std::popcount(mutate(parent, MutationKind::single_pixel, random).bits() ^ parent.bits()) > 1;
  }
  EXPECT_GT(far, 200);
}

TEST(Mutation, IsReproducible) {
  const auto walk = [] {
    RandomStream random(8, "test");
    Pattern pattern = random_pattern(random);
    for (int i = 0; i < 500; ++i) pattern = mutate(pattern, MutationKind::three_way, random);
    return pattern;
  };
  EXPECT_EQ(walk(), walk());
}

}  // namespace
}  // namespace nacre::pattern
