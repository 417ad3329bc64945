#include "select/select.hpp"

#include <chrono>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../instrumented.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::select {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using Gamut = std::vector<explore::Evaluated>;

std::vector<pattern::Pattern> random_patterns(int count, std::uint64_t seed) {
  RandomStream random(seed, "test");
  std::set<pattern::Pattern> patterns;
  while (static_cast<int>(patterns.size()) < count) patterns.insert(pattern::random_pattern(random));
  return {patterns.begin(), patterns.end()};
}

/// A quarter circle as the front, with samples scattered inside it.
Gamut round_gamut(int on_front, int inside, std::uint64_t seed = 1) {
  RandomStream random(seed, "test/gamut");
  const auto patterns = random_patterns(on_front + inside, seed);
  Gamut gamut;
  for (int i = 0; i < on_front + inside; ++i) {
    const double angle = random.uniform(0.0, M_PI / 2),
                 radius = i < on_front ? 1.0 : std::sqrt(random.uniform()) * 0.95;
    gamut.push_back({patterns[i], {radius * std::cos(angle) * 2e9, radius * std::sin(angle) * 1e6}});
  }
  return gamut;
}

bool contains(const Gamut& gamut, const Selected& selected) {
  return std::find(gamut.begin(), gamut.end(), explore::Evaluated{selected.pattern, selected.predicted}) != gamut.end();
}

TEST(SelectDesigns, CoverTheFrontWithOneDesignPerBin) {
  const Gamut gamut = round_gamut(100, 1000);
  const auto measured = random_patterns(10, 77);
  const auto selected = select_designs(gamut, measured, {}, {});
  ASSERT_EQ(selected.size(), 8u);
  std::set<pattern::Pattern> patterns;
  for (int bin = 0; bin < 8; ++bin) {
    const Selected& design = selected[bin];
    EXPECT_EQ(design.bin, bin);
    EXPECT_TRUE(contains(gamut, design));
    patterns.insert(design.pattern);
    const std::string place = bin == 0   ? "in the least stiff of 8 parts of the front"
                              : bin == 7 ? "in the stiffest of 8 parts of the front"
                                         : "in part " + std::to_string(bin + 1) + " of 8 of the front";
    EXPECT_THAT(design.reason, HasSubstr("near the best predicted toughness for its stiffness, " + place));
    EXPECT_THAT(design.reason, MatchesRegex(".* measured [a-z ]+\\([0-9]+ of 400 pixels differ, [0-9]+ from the other "
                                            "proposals\\)"));
    if (bin > 0) {
      EXPECT_GT(design.predicted.modulus_pa, selected[static_cast<std::size_t>(bin) - 1].predicted.modulus_pa * 0.9);
    }
  }
  EXPECT_EQ(patterns.size(), 8u);
  EXPECT_GT(selected.back().predicted.modulus_pa, 1.8e9);
  EXPECT_LT(selected.front().predicted.modulus_pa, 0.6e9);
}

TEST(SelectDesigns, TakesThePatternThatDiffersMostFromTheMeasured) {
  // One bin, three equally good designs at known distances from what was measured.
  pattern::Pattern near, middle, far, measured;
  middle.set(0, 1, true), middle.set(0, 2, true);
  near.set(0, 1, true);
  far.set(0, 1, true), far.set(0, 2, true), far.set(0, 3, true);
  const Gamut gamut = {{near, {1e9, 1e6}}, {far, {1e9, 1e6}}, {middle, {1e9, 1e6}}};
  const auto selected = select_designs(gamut, std::vector{measured}, {}, {.count = 1});
  ASSERT_EQ(selected.size(), 1u);
  EXPECT_EQ(selected[0].pattern, far);
  EXPECT_EQ(
      selected[0].reason,
      "near the best predicted toughness for its stiffness; close to a measured design (24 of 400 pixels differ)");
}

TEST(SelectDesigns, OfTwoOneIsOfTheLeastStiffHalfAndOneOfTheStiffest) {
  const auto selected = select_designs(round_gamut(50, 100), random_patterns(3, 9), {}, {.count = 2});
  ASSERT_EQ(selected.size(), 2u);
  EXPECT_THAT(selected[0].reason, HasSubstr("in the least stiff half; unlike anything measured so far ("));
  EXPECT_THAT(selected[1].reason, HasSubstr("in the stiffest half; unlike anything measured so far ("));
}

TEST(SelectDesigns, EmptyBinsAreFilledFromTheRemainingCandidatesAndSaySo) {
  // Toughest and stiffest corners only: the bins between them are empty.
  Gamut gamut;
  const auto patterns = random_patterns(10, 3);
  for (int i = 0; i < 10; ++i) {
    const bool tough = i < 5;
    const double step = i % 5;
    gamut.push_back({patterns[i],
                     {(tough ? 1.0 + 0.001 * step : 2.0 + 0.001 * step) * 1e9,
                      (tough ? 1.0 - 0.001 * step : 0.1 - 0.001 * step) * 1e6}});
  }
  const auto selected = select_designs(gamut, {}, {}, {.count = 4});
  ASSERT_EQ(selected.size(), 4u);
  EXPECT_EQ(selected[0].bin, 0);
  EXPECT_EQ(selected[1].bin, 3);
  for (const std::size_t i : {2u, 3u}) {
    EXPECT_EQ(selected[i].bin, -1);
    EXPECT_THAT(selected[i].reason, HasSubstr("taken because parts 2 and 3 of 4 of the front hold no candidate"));
    EXPECT_THAT(selected[i].reason, MatchesRegex(".*; nothing is measured yet \\([0-9]+ of 400 pixels differ from the "
                                                 "other proposals\\)"));
  }
  std::set<pattern::Pattern> different;
  for (const Selected& design : selected) different.insert(design.pattern);
  EXPECT_EQ(different.size(), 4u);
}

TEST(SelectDesigns, FewerCandidatesThanWantedComeBackAll) {
  const Gamut gamut = round_gamut(5, 0);
  const auto selected = select_designs(gamut, {}, {}, {.count = 8});
  EXPECT_EQ(selected.size(), 5u);
}

TEST(SelectDesigns, OneSampleAndNoSampleAreFine) {
  EXPECT_TRUE(select_designs({}, {}, {}, {}).empty());
  const Gamut one = round_gamut(1, 0);
  const auto selected = select_designs(one, {}, {}, {});
  ASSERT_EQ(selected.size(), 1u);
  EXPECT_EQ(selected[0].pattern, one[0].pattern);
  EXPECT_THAT(selected[0].reason, HasSubstr("nothing is measured yet"));
  EXPECT_TRUE(select_designs(one, std::vector{one[0].pattern}, {}, {}).empty());
}

TEST(SelectDesigns, SamplesOnALineAreSelectedAllTheSame) {
  const auto patterns = random_patterns(12, 5);
  Gamut falling, flat, upright;
  for (int i = 0; i < 12; ++i) {
    const auto& pattern = patterns[i];
    falling.push_back({pattern, {(1.0 + i) * 1e8, (12.0 - i) * 1e5}});
    flat.push_back({pattern, {(1.0 + i) * 1e8, 1e6}});
    upright.push_back({pattern, {1e9, (1.0 + i) * 1e5}});
  }
  EXPECT_EQ(select_designs(falling, {}, {}, {.count = 4}).size(), 4u);
  EXPECT_EQ(select_designs(flat, {}, {}, {.count = 4}).size(), 3u) << "ranks 1 to 3";
  EXPECT_EQ(select_designs(upright, {}, {}, {.count = 4}).size(), 1u) << "l2 runs through the toughest of the stiffest";
}

TEST(SelectDesigns, StayAboveTheBenchmark) {
  const Gamut gamut = round_gamut(100, 200);
  const std::vector<optimize::Performance> benchmark = {{0.1e9, 0.97e6}, {1.9e9, 0.97e6}, {1.95e9, 0.05e6}};
  const auto selected = select_designs(gamut, {}, benchmark, {.count = 4});
  ASSERT_FALSE(selected.empty());
  for (const Selected& design : selected) {
    EXPECT_TRUE(design.predicted.toughness_pa > 0.97e6 || design.predicted.modulus_pa > 1.9e9) << design.reason;
  }
  const std::vector<optimize::Performance> unbeaten = {{3e9, 3e6}};
  EXPECT_TRUE(select_designs(gamut, {}, unbeaten, {}).empty());
}

TEST(SelectWithReserve, TakesTheFirstRanksAloneAndWarnsWhereAPlainMixtureIsAsGood) {
  const auto patterns = random_patterns(6, 4);
  const Gamut gamut = {
      {patterns[0], {3.0e9, 3.0e6}}, {patterns[1], {2.9e9, 2.9e6}}, {patterns[2], {2.8e9, 2.8e6}},
      {patterns[3], {3.5e9, 0.1e6}}, {patterns[4], {2.7e9, 1.5e6}},  // of rank 4: its T is that of one simulation
      {patterns[5], {0.5e9, 3.1e6}},
  };
  const std::vector<optimize::Performance> benchmark = {{1e9, 3.2e6}};
  const auto selected = select_with_reserve(gamut, {}, benchmark, 6);
  ASSERT_EQ(selected.size(), 5u);
  for (const Selected& design : selected) {
    EXPECT_NE(design.pattern, patterns[4]) << design.reason;
    const bool below = design.reason.find("warning: a plain mixture is as stiff and as tough") != std::string::npos;
    EXPECT_EQ(below, design.pattern == patterns[5]) << design.reason;
    EXPECT_THAT(design.reason, HasSubstr("nothing is measured yet (")) << "what is only chosen is not measured";
  }
}

TEST(SelectDesigns, AreReproducible) {
  const Gamut gamut = round_gamut(50, 500);
  const auto a = select_designs(gamut, {}, {}, {}), b = select_designs(gamut, {}, {}, {});
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].pattern, b[i].pattern);
}

TEST(SelectDesigns, FromAHundredThousandSamplesTakeAboutASecondAtMost) {
  const Gamut gamut = round_gamut(3000, 97000);
  const auto measured = random_patterns(50, 8);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(select_designs(gamut, measured, {}, {}).size(), 8u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, test::kPatience * std::chrono::seconds(2));
}

TEST(SelectDesigns, RefuseSettingsThatMeanNothing) {
  EXPECT_THROW(select_designs({}, {}, {}, {.count = 0}), InputError);
  EXPECT_THROW(select_designs({}, {}, {}, {.count = 1, .beam_width = 0}), InputError);
  EXPECT_THROW(select_designs({}, {}, {}, {.count = 1, .beam_width = 1, .maximum_rank = 0}), InputError);
}

}  // namespace
}  // namespace nacre::select
