#include "sysid/strength_variation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "base/square.hpp"
#include "base/statistics.hpp"
#include "material/parameters.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/expected_toughness.hpp"

namespace nacre::sysid {
namespace {

constexpr int kDesigns = 18;
constexpr double kExponent = 0.5;

double sample_variance(RandomStream& random, double sd, int freedom) {
  double sum = 0.0;
  for (int k = 0; k < freedom; ++k) sum += square(sd * random.normal());
  return sum / freedom;
}

/// Four replicates and three simulated specimens each of designs that scatter by 0.04 to 0.12 at a variation of 0.1, in
/// a laboratory of this variation that measures with 0.03.
std::vector<DesignScatter> drawn(std::uint64_t seed, double strength_cv) {
  RandomStream random(seed, "strength variation");
  std::vector<DesignScatter> designs;
  for (int d = 0; d < kDesigns; ++d) {
    const double middle = random.uniform(0.04, 0.12);
    const auto sd = [&](double cv) { return middle * std::pow(cv / 0.1, kExponent); };
    designs.push_back({.measured_variance = sample_variance(random, std::hypot(0.03, sd(strength_cv)), 3),
                       .measured_freedom = 3,
                       .small_variance = sample_variance(random, sd(kSmallVariation), 2),
                       .large_variance = sample_variance(random, sd(kLargeVariation), 2),
                       .small_freedom = 2,
                       .large_freedom = 2});
  }
  return designs;
}

TEST(StrengthVariation, IntervalsHoldTheTruthThatMadeTheScatter) {
  int inside = 0, laboratories = 0;
  for (const double strength_cv : {0.06, 0.1, 0.17}) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed, ++laboratories) {
      const StrengthVariation fitted = fit_strength_variation(drawn(seed, strength_cv), 0.03);
      inside += fitted.low90 <= strength_cv && strength_cv <= fitted.high90;
      EXPECT_LT(fitted.correlation, 0.0) << "what is measuring is not strength";
    }
  }
  EXPECT_GE(inside, 0.84 * laboratories);
  EXPECT_LE(inside, 0.97 * laboratories);
}

TEST(StrengthVariation, LargerScatterIsLargerVariation) {
  std::vector<double> low, high;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    low.push_back(fit_strength_variation(drawn(seed, 0.05), 0.03).strength_cv);
    high.push_back(fit_strength_variation(drawn(seed, 0.25), 0.03).strength_cv);
  }
  EXPECT_LT(mean(low), 0.085);
  EXPECT_GT(mean(high), 0.14);
}

TEST(StrengthVariation, PredictsTheScatterThatItWasFittedTo) {
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const StrengthVariation fitted = fit_strength_variation(drawn(seed, 0.13), 0.03);
    EXPECT_EQ(fitted.freedom, 3 * kDesigns);
    ratios.push_back(fitted.predicted_sd / fitted.measured_sd);
  }
  EXPECT_NEAR(mean(ratios), 1.0, 0.05);
}

TEST(StrengthVariation, ASingleDesignLeavesThePrior) {
  const DesignScatter one[] = {{.measured_variance = square(0.09),
                                .measured_freedom = 1,
                                .small_variance = square(0.064),
                                .large_variance = square(0.127)}};
  const StrengthVariation fitted = fit_strength_variation(one, 0.03);
  EXPECT_NEAR(fitted.strength_cv, 0.10, 0.02);
  EXPECT_FALSE(fitted.determined());
}

TEST(StrengthVariation, VariancesShrinkByWhatChanceAdds) {
  const auto with = [](double variance, int freedom) {
    return DesignScatter{0.0, 3, variance, variance, freedom, freedom};
  };
  const std::vector<DesignScatter> alike = {with(0.010, 3), with(0.011, 3), with(0.009, 3)},
                                   unlike = {with(0.001, 300), with(0.02, 300)};
  for (const double variance : scatter_growth(alike).variances) EXPECT_NEAR(variance, 0.010, 1e-12);
  EXPECT_NEAR(scatter_growth(unlike).variances[0], 0.001, 2e-4);
  EXPECT_EQ(scatter_growth(alike).exponent, 0.0);
}

TEST(StrengthVariation, TheExponentIsThatOfTheSimulations) {
  const std::vector<DesignScatter> designs = {{0.0, 3, 0.001, 0.004, 2, 2}, {0.0, 3, 0.002, 0.008, 2, 2}};
  const ScatterGrowth growth = scatter_growth(designs);
  EXPECT_NEAR(growth.exponent, 0.5, 1e-9);
  EXPECT_NEAR(growth.variance(0, kSmallVariation) + growth.variance(1, kSmallVariation), 0.003, 1e-9);
}

TEST(StrengthVariation, OnlyReplicatedDesignsTell) {
  measurement::Replicates twice, once;
  twice.toughness_count = 2, twice.toughness_pa = 1e5, twice.toughness_sd_pa = 1e4;
  once.toughness_count = 1, once.toughness_pa = 1e5;
  Prediction four;
  four.toughness_pa = 2e5, four.toughness_sd_pa = 1e4, four.specimens = 4;
  const std::vector<DesignScatter> told =
      design_scatter({twice, once, twice}, {four, four, Prediction{}}, {four, four, four});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NEAR(std::sqrt(told[0].measured_variance), 0.1, 1e-3);
  EXPECT_NEAR(std::sqrt(told[0].large_variance), 0.05, 1e-3);
  EXPECT_EQ(told[0].small_freedom, 3);
}

/// The law behind the fit, by the tester itself: scatter between those two variations, from what it is there.
TEST(StrengthVariation, ScatterInBetweenIsThatOfThePowerLaw) {
  constexpr double kBetween = 0.1;
  constexpr int kSpecimens = 8;
  RandomStream random(1, "layouts");
  std::vector<DesignScatter> designs;
  double between = 0.0, expected = 0.0;
  for (const pattern::Pattern& layout : pattern::stratified_patterns(4, random)) {
    const auto variance_at = [&](double strength_cv) {
      tester::Simulation simulation;
      simulation.design = layout;
      simulation.fidelity = tester::Fidelity::tiny;
      simulation.parameters = material::default_parameters();
      simulation.parameters.strength_cv = strength_cv;
      const auto toughness = tester::expected_toughness(simulation, kSpecimens);
      return square(toughness.value().toughness_sd_pa.value() / toughness.value().toughness_pa);
    };
    designs.push_back(
        {0.0, 3, variance_at(kSmallVariation), variance_at(kLargeVariation), kSpecimens - 1, kSpecimens - 1});
    between += variance_at(kBetween);
  }
  const ScatterGrowth growth = scatter_growth(designs);
  for (std::size_t d = 0; d < designs.size(); ++d) expected += growth.variance(d, kBetween);
  EXPECT_NEAR(std::sqrt(expected / between), 1.0, 0.25);
}

}  // namespace
}  // namespace nacre::sysid
