#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "base/files.hpp"
#include "base/result.hpp"
#include "families/barycentre.hpp"
#include "families/dense_sampling.hpp"
#include "families/distances.hpp"
#include "families/earth_movers.hpp"
#include "families/families_file.hpp"
#include "families/grouping.hpp"
#include "families/interpolation.hpp"
#include "families/isomap.hpp"
#include "pattern/constraints.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::families {
namespace {

using pattern::Pattern;

Pattern with_soft(std::initializer_list<std::pair<int, int>> pixels) {
  Pattern pattern(pattern::kAllFreePixels);
  for (const auto& [row, column] : pixels) pattern.set(row, column, false);
  return pattern;
}

std::vector<Pattern> random_patterns(int count) {
  RandomStream random(3, "families test");
  return pattern::stratified_patterns(count, random);
}

TEST(Barycentre, OfOnePatternIsItself) {
  for (const Pattern& pattern : random_patterns(8)) {
    EXPECT_EQ(barycentre(std::vector{pattern}, std::vector{1.0}), pattern);
    EXPECT_EQ(barycentre(std::vector{pattern, pattern, pattern}, std::vector{0.2, 0.3, 0.5}), pattern);
  }
  const std::vector<Pattern> three = random_patterns(3);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> weights(3, 0.0);
    weights[k] = 1.0;
    EXPECT_EQ(barycentre(three, weights), three[k]) << "all weight on one source";
    EXPECT_EQ(barycentre(three, weights, BarycentreCut::amount), three[k]) << "all weight on one source";
  }
}

TEST(Barycentre, LiesHalfWayOfASoftPixel) {
  const std::vector<Pattern> ends = {with_soft({{2, 2}, {0, 9}}), with_soft({{6, 6}, {0, 9}})};
  EXPECT_EQ(barycentre(ends, std::vector{1.0, 1.0}), with_soft({{4, 4}, {0, 9}}));
  EXPECT_EQ(barycentre(ends, std::vector{3.0, 1.0}), with_soft({{3, 3}, {0, 9}}));
}

TEST(Barycentre, CutByAmountLiesBetweenItsSourcesInRigidFraction) {
  const std::vector<Pattern> patterns = random_patterns(12);
  for (std::size_t k = 0; k + 2 < patterns.size(); ++k) {
    const std::vector<Pattern> three(patterns.begin() + static_cast<std::ptrdiff_t>(k),
                                     patterns.begin() + static_cast<std::ptrdiff_t>(k) + 3);
    const std::vector<double> weights = {0.9, 0.02, 0.08};
    double mean = 0.0, most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      mean += weights[i] * three[i].rigid_fraction();
      most = std::max(most, three[i].rigid_fraction());
    }
    const auto between = barycentre(three, weights, BarycentreCut::amount);
    ASSERT_TRUE(between);
    constexpr double kCell = 0.011;  // one of a hundred
    EXPECT_GE(between->rigid_fraction(), mean - kCell);
    EXPECT_LE(between->rigid_fraction(), most + kCell) << "earth may lie on earth: somewhat more rigid than the mean";
  }
}

TEST(Barycentre, HasNothingToMoveIntoAPatternThatOthersContain) {
  const std::vector<Pattern> nested = {with_soft({{2, 2}}), with_soft({{2, 2}, {5, 5}})};
  EXPECT_FALSE(barycentre(nested, std::vector{1.0, 1.0}));
}

TEST(DenseSampler, FindsFeasiblePatternsWithinTheRadiusOnce) {
  std::vector<Pattern> seeds = random_patterns(2);
  DenseSampler sampler(seeds, {});
  std::set<Pattern> found(seeds.begin(), seeds.end());
  for (int iteration = 0; iteration < 30; ++iteration) {
    const std::vector<Pattern> batch = sampler.next();
    ASSERT_EQ(batch.size(), 10u);
    for (const Pattern& pattern : batch) {
      EXPECT_TRUE(pattern::is_feasible(pattern));
      EXPECT_LE(nearest_seed(pattern, seeds).difference, 16);
      EXPECT_TRUE(found.insert(pattern).second);
    }
  }
  EXPECT_EQ(sampler.members().size(), found.size());
}

TEST(DenseSampler, EndsWhenTheFamilyIsExhausted) {
  const Pattern seed = random_patterns(5)[2];
  DenseSampler sampler({seed},
                       {.radius_pixels = 4, .batch = 10, .attempts = 20'000, .seed = 1});  // diagonal pixels alone
  std::set<Pattern> found, expected;
  while (!sampler.exhausted())
    for (const Pattern& pattern : sampler.next()) found.insert(pattern);
  for (int i = 0; i < pattern::kQuarter; ++i) {
    Pattern flipped = seed;
    flipped.set(i, i, !seed.rigid(i, i));
    if (pattern::is_feasible(flipped)) expected.insert(flipped);
  }
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(sampler.next().empty());
  EXPECT_THROW(DenseSampler({}, {}), InputError);
}

TEST(Interpolation, AddsFeasiblePatternsNearTheSeedThatAreNew) {
  const Pattern seed = random_patterns(3).back();
  DenseSampler sampler({seed}, {});
  while (sampler.members().size() < 150) sampler.next();
  const std::vector<Pattern>& members = sampler.members();
  const Embedding map = isomap(earth_movers_distances(members));
  const std::vector<Pattern> added = interpolated(seed, members, map.points);
  EXPECT_GT(added.size(), 5u);
  std::set<Pattern> known(members.begin(), members.end());
  for (const Pattern& pattern : added) {
    EXPECT_TRUE(known.insert(pattern).second);
    EXPECT_TRUE(pattern::is_feasible(pattern));
    EXPECT_LE(pattern::pixel_difference(pattern, seed), 16);
  }
}

/// Six neighbours of a soft, a middle and a stiff pattern, one after another.
std::vector<MeasuredPattern> three_kinds() {
  const std::vector<Pattern> seeds = random_patterns(12);
  std::vector<MeasuredPattern> designs;
  for (const std::size_t kind : {0u, 5u, 11u}) {  // strata
    DenseSampler sampler({seeds[kind]}, {.seed = kind + 1});
    sampler.next();
    for (std::size_t i = 0; i < 6; ++i)
      designs.push_back({sampler.members()[i],
                         {1e9 * (1.0 + static_cast<double>(kind)) + 1e7 * static_cast<double>(i),
                          1e5 * (12.0 - static_cast<double>(kind))}});
  }
  return designs;
}

TEST(Grouping, FindsTheFamiliesThatWerePlanted) {
  const std::vector<MeasuredPattern> designs = three_kinds();
  const std::vector<SeedFamily> families = proposed_families(designs);
  ASSERT_EQ(families.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(families[k].seeds.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_EQ(families[k].seeds[i], designs[6 * (2 - k) + i].pattern) << "by falling modulus";
  }
}

TEST(Grouping, APatternWithoutSoftPixelsStandsAsideAndDisturbsNobody) {
  std::vector<MeasuredPattern> designs = three_kinds();
  for (MeasuredPattern& design : designs) design.performance = {2e9, 5e5};  // shape alone tells
  const std::vector<SeedFamily> without = proposed_families(designs);
  Pattern rigid;
  for (int i = 0; i < pattern::kQuarter; ++i)
    for (int j = 0; j < pattern::kQuarter; ++j) rigid.set(i, j, true);
  designs.push_back({rigid, {2e9, 5e5}});
  const std::vector<SeedFamily> with = proposed_families(designs);
  ASSERT_EQ(with.size(), without.size() + 1);
  for (const SeedFamily& family : without)
    EXPECT_TRUE(std::ranges::any_of(with, [&](const SeedFamily& each) { return each.seeds == family.seeds; }));
}

TEST(Grouping, SeesOneFamilyWhereNothingParts) {
  const Pattern seed = random_patterns(4).back();
  DenseSampler sampler({seed}, {});
  while (sampler.members().size() < 30) sampler.next();
  RandomStream random(5, "properties");
  std::vector<MeasuredPattern> designs;
  for (const Pattern& pattern : sampler.members())
    designs.push_back({pattern, {random.uniform(1e9, 1.1e9), random.uniform(1e5, 1.1e5)}});
  EXPECT_EQ(proposed_families(designs).size(), 1u);
}

TEST(Grouping, KeepsTheFirstRanksOfWhatWasMeasured) {
  const std::vector<Pattern> some = random_patterns(4);
  const std::vector<MeasuredPattern> measured = {
      {some[0], {3.0, 1.0}}, {some[1], {2.0, 2.0}}, {some[2], {1.5, 1.5}}, {some[3], {1.0, 1.0}}};
  EXPECT_EQ(near_pareto(measured, 1).size(), 2u);
  EXPECT_EQ(near_pareto(measured, 2).size(), 3u);
}

TEST(FamiliesFile, ComesBackAsItWasWritten) {
  const std::vector<Pattern> some = random_patterns(4);
  const std::vector<SeedFamily> families = {{"family-1", {some[0], some[1]}}, {"arcs", {some[2]}}};
  const auto file = std::filesystem::path(testing::TempDir()) / "families.toml";
  write_file_atomically(file, to_toml(families));
  EXPECT_EQ(read_families(file), families);
  const auto refused = [&](const std::string& text, const std::string& why) {
    write_file_atomically(file, text);
    try {
      read_families(file);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused("[[family]]\nname = \"a\"\nseeds = []\n", "families.toml:1:1: expected seeds = [\"key\", ...] in the family");
  refused("[[family]]\nname = \"a/b\"\nseeds = [\"577fffe9fffdef\"]\n", "families.toml:1:1: expected a name");
  refused("[[family]]\nname = \"2\"\nseeds = [\"577fffe9fffdef\"]\n", "not digits alone");
  refused("[[family]]\nname = \"" + std::string(65, 'a') + "\"\nseeds = [\"577fffe9fffdef\"]\n", "at most 64");
  refused("[[family]]\nname = \"a\"\nseeds = [\"577f\"]\n", "families.toml:3:10: seed '577f'");
  refused(
      "[[family]]\nname = \"a\"\nseeds = [\"577fffe9fffdef\"]\n[[family]]\nname = \"b\"\nseeds = "
      "[\"577fffe9fffdef\"]\n",
      "families.toml:4:1: seed '577fffe9fffdef' is listed a second time");
}

}  // namespace
}  // namespace nacre::families
