#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "select/beam.hpp"
#include "select/candidates.hpp"
#include "select/radial_bins.hpp"

namespace nacre::select {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<explore::Evaluated> gamut_of(const std::vector<optimize::Performance>& performances,
                                         std::uint64_t seed = 1) {
  RandomStream random(seed, "test");
  const auto patterns = pattern::stratified_patterns(static_cast<int>(performances.size()), random);
  std::vector<explore::Evaluated> gamut;
  for (std::size_t i = 0; i < performances.size(); ++i) gamut.push_back({patterns[i], performances[i]});
  return gamut;
}

TEST(AbovePolyline, MeansThatNoPointOfTheLineIsAsGoodInBoth) {
  // Ordered by rigid fraction; toughness first rises, then falls with the modulus.
  const std::vector<optimize::Performance> line = {{1, 2}, {2, 4}, {4, 1}};
  EXPECT_FALSE(above_polyline({1, 1}, line));
  EXPECT_FALSE(above_polyline({2, 4}, line)) << "on the line is not above it";
  EXPECT_FALSE(above_polyline({3, 2.5}, line)) << "on the line between its points";
  EXPECT_TRUE(above_polyline({3, 2.51}, line));
  EXPECT_FALSE(above_polyline({0.5, 3.9}, line)) << "left of the line but dominated by it";
  EXPECT_TRUE(above_polyline({0.5, 4.1}, line)) << "tougher than all of it";
  EXPECT_TRUE(above_polyline({4.1, 0.1}, line)) << "stiffer than all of it";
}

TEST(AbovePolyline, TheOrderGivenMattersNotTheModulus) {
  // A line that turns back in modulus, as measured mixtures may.
  const std::vector<optimize::Performance> line = {{1, 1}, {3, 3}, {2, 5}};
  EXPECT_FALSE(above_polyline({2.4, 4}, line));
  EXPECT_TRUE(above_polyline({2.6, 4}, line));
}

TEST(AbovePolyline, AgreesWithManyPointsOnTheLine) {
  RandomStream random(3, "test");
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<optimize::Performance> line;
    for (int i = 0; i < 4; ++i) line.push_back({random.uniform(), random.uniform()});
    const optimize::Performance point{random.uniform(), random.uniform()};
    bool reached = false;
    double margin = 1.0;
    for (int i = 0; i + 1 < 4; ++i) {
      const auto &a = line[i], &b = line[static_cast<std::size_t>(i) + 1];
      for (int k = 0; k <= 2000; ++k) {
        const double t = k / 2000.0;
        const double shortfall = std::max(point.modulus_pa - a.modulus_pa - t * (b.modulus_pa - a.modulus_pa),
                                          point.toughness_pa - a.toughness_pa - t * (b.toughness_pa - a.toughness_pa));
        reached |= shortfall <= 0.0;
        margin = std::min(margin, std::abs(shortfall));
      }
    }
    if (margin < 2e-3) continue;  // too close for the sampled line to tell
    EXPECT_EQ(above_polyline(point, line), !reached);
  }
}

TEST(AbovePolyline, NoBenchmarkForbidsNothingAndOnePointIsALine) {
  EXPECT_TRUE(above_polyline({0, 0}, {}));
  const std::vector<optimize::Performance> point = {{2, 2}};
  EXPECT_FALSE(above_polyline({2, 1}, point));
  EXPECT_TRUE(above_polyline({2.1, 1}, point));
}

TEST(Candidates, AreNearTheBoundaryAboveBothLinesAndNotMeasured) {
  //                                  rank 1     rank 1     rank 2      rank 3    rank 4    below l2
  const auto gamut = gamut_of({{3e9, 3e6}, {5e9, 1e6}, {3e9, 2.9e6}, {2e9, 2e6}, {1e9, 1.5e6}, {4.9e9, 0.9e6}});
  EXPECT_EQ(stiffest_sample_toughness_pa(gamut), 1e6);
  EXPECT_EQ(candidates(gamut, {}, {}, 3), (std::vector{gamut[0], gamut[1], gamut[2], gamut[3]}));
  EXPECT_EQ(candidates(gamut, {}, {}, 1), (std::vector{gamut[0], gamut[1]}));
  const std::vector<pattern::Pattern> measured = {gamut[1].pattern, gamut[3].pattern};
  EXPECT_EQ(candidates(gamut, measured, {}, 3), (std::vector{gamut[0], gamut[2]}));
  const std::vector<optimize::Performance> benchmark = {{2.5e9, 2.5e6}, {4e9, 0.5e6}};
  EXPECT_EQ(candidates(gamut, {}, benchmark, 3), (std::vector{gamut[0], gamut[1], gamut[2]}));
  EXPECT_TRUE(candidates({}, {}, {}, 3).empty());
}

TEST(Candidates, HoldEachPatternOnce) {
  auto gamut = gamut_of({{3e9, 3e6}, {5e9, 1e6}});
  gamut.push_back(gamut[0]);
  EXPECT_EQ(candidates(gamut, {}, {}, 3).size(), 2u);
}

TEST(ElevationAngles, TheToughestLiesOnTheAxisUnlessItIsStifferThanTheMiddle) {
  // Toughest at modulus 2 of [1, 5]: left of the middle, so it is mapped to zero; the stiffest lies on the other axis.
  const auto left = elevation_angles(gamut_of({{1e9, 2e6}, {2e9, 3e6}, {5e9, 1e6}}));
  EXPECT_DOUBLE_EQ(left[1], kPi / 2);
  EXPECT_DOUBLE_EQ(left[2], 0.0);
  EXPECT_DOUBLE_EQ(left[0], std::atan2(0.5, -1.0 / 3.0));
  // Toughest at 4 of [1, 5]: the middle, 3, is mapped to zero, the softest to -1.
  const auto right = elevation_angles(gamut_of({{1e9, 2e6}, {4e9, 3e6}, {5e9, 1e6}}));
  EXPECT_DOUBLE_EQ(right[1], std::atan2(1.0, 0.5));
  EXPECT_DOUBLE_EQ(right[0], std::atan2(0.5, -1.0));
}

TEST(ElevationAngles, DegenerateCandidatesHaveAnglesToo) {
  EXPECT_EQ(elevation_angles(gamut_of({{1e9, 1e6}})), std::vector{kPi / 2});
  for (const double angle : elevation_angles(gamut_of({{1e9, 1e6}, {1e9, 2e6}, {1e9, 3e6}})))
    EXPECT_DOUBLE_EQ(angle, kPi / 2);
  const auto flat = elevation_angles(gamut_of({{1e9, 1e6}, {2e9, 1e6}, {3e9, 1e6}}));
  EXPECT_GT(flat[0], flat[1]);
  EXPECT_GT(flat[1], flat[2]);
}

TEST(RadialBins, EquationTwoThirteenMakesTheLeftBinsNoLargerThanTheRightOnesWithTheFewestBins) {
  for (const int count : {2, 5, 8, 20}) {
    for (double largest = 96.0; largest <= 180.0; largest += 1.0) {
      const double angle = largest / 180.0 * kPi;
      const int left = second_quadrant_bins(angle, count);
      const auto left_size = [&](int bins) { return (angle - kPi / 2) / bins; };
      const auto right_size = [&](int bins) { return kPi / 2 / (count - bins); };
      ASSERT_GE(left, 1);
      ASSERT_LT(left, count);
      EXPECT_LE(left_size(left), right_size(left) + 1e-12);
      if (left > 1) {
        EXPECT_GT(left_size(left - 1), right_size(left - 1));
      }
    }
    EXPECT_EQ(second_quadrant_bins(94.9 / 180.0 * kPi, count), 0);
  }
  EXPECT_EQ(second_quadrant_bins(kPi, 1), 0);
}

TEST(RadialBins, ShareEachQuadrantEqually) {
  // The figure's example: M = 5, L = 1.
  const double largest = 110.0 / 180.0 * kPi;
  ASSERT_EQ(second_quadrant_bins(largest, 5), 1);
  const double expected[][2] = {{110, 0}, {91, 0}, {90, 1}, {68, 1}, {67, 2},
                                {46, 2},  {44, 3}, {23, 3}, {22, 4}, {0, 4}};
  for (const auto& [degrees, bin] : expected) EXPECT_EQ(radial_bin(degrees / 180.0 * kPi, largest, 5), bin) << degrees;
  EXPECT_EQ(radial_bin(92.0 / 180.0 * kPi, 93.0 / 180.0 * kPi, 4), 0) << "no second quadrant: the first bin takes it";
}

/// Objective of Eq. 2.14 without its factor 1/M, as it is written.
int dissimilarity(const std::vector<pattern::Pattern>& chosen, const std::vector<pattern::Pattern>& measured) {
  int sum = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    std::vector<pattern::Pattern> others = chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    sum += std::min(smallest_difference(chosen[i], others), smallest_difference(chosen[i], measured));
  }
  return sum;
}

/// The best selection by trying all.
int best_by_enumeration(const std::vector<std::vector<pattern::Pattern>>& bins,
                        const std::vector<pattern::Pattern>& measured) {
  std::vector<std::size_t> choice(bins.size(), 0);
  for (int best = 0;;) {
    std::vector<pattern::Pattern> chosen;
    for (std::size_t b = 0; b < bins.size(); ++b) chosen.push_back(bins[b][choice[b]]);
    best = std::max(best, dissimilarity(chosen, measured));
    std::size_t b = 0;
    while (b < bins.size() && ++choice[b] == bins[b].size()) choice[b++] = 0;
    if (b == bins.size()) return best;
  }
}

/// Bins of random patterns, measured patterns, and what beam search makes of them.
struct Instance {
  std::vector<std::vector<pattern::Pattern>> bins;
  std::vector<pattern::Pattern> measured;
  Instance(int bin_count, int bin_size, int measured_count, RandomStream& random)
      : measured(pattern::stratified_patterns(measured_count, random)) {
    for (int b = 0; b < bin_count; ++b) bins.push_back(pattern::stratified_patterns(bin_size, random));
  }
  int found(int width) const {
    const auto choice = beam_search(bins, measured, width);
    std::vector<pattern::Pattern> chosen;
    for (std::size_t b = 0; b < bins.size(); ++b) chosen.push_back(bins[b][choice[b]]);
    return dissimilarity(chosen, measured);
  }
};

TEST(BeamSearch, IsExactWhenTheBeamHoldsEveryPartialSelection) {
  RandomStream random(1, "test");
  for (const int measured : {0, 1, 10}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Instance instance(4, 4, measured, random);  // 64 partial selections before the last bin
      EXPECT_EQ(instance.found(100), best_by_enumeration(instance.bins, instance.measured));
    }
  }
}

TEST(BeamSearch, OfWidthAHundredLosesLittleWhereItIsNotExact) {
  RandomStream random(2, "test");
  double worst = 1.0;
  for (const int measured : {0, 10}) {
    for (int trial = 0; trial < 10; ++trial) {
      const Instance instance(5, 8, measured, random);  // 4096 partial selections
      const int best = best_by_enumeration(instance.bins, instance.measured);
      worst = std::min(worst, instance.found(100) / static_cast<double>(best));
      EXPECT_LE(instance.found(1), best);
    }
  }
  EXPECT_GE(worst, 0.97);
}

}  // namespace
}  // namespace nacre::select
