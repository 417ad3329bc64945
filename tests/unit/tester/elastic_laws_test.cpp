// Extensions of elastic tests: how stiffness goes with the rate, and blends beside the mixture law.

#include <gtest/gtest.h>

#include <cmath>

#include "material/blend_law.hpp"
#include "material/rate_laws.hpp"
#include "tester/modulus.hpp"

namespace nacre::material {
namespace {

double modulus_at(const pattern::Design& design, const Extensions& extensions, double rate_per_s) {
  tester::Simulation simulation{design, default_parameters(), {}, tester::Fidelity::tiny};
  simulation.parameters.extensions = extensions;
  simulation.conditions.strain_rate_per_s = rate_per_s;
  return tester::test_modulus(simulation).value().modulus_pa;
}

TEST(RatePowerLaw, EveryPhaseHasItsExponent) {
  const Extensions law = {{"rate_power_law", {0.2, 0.5, 0.1}}};
  for (const auto& [share, exponent] : {std::pair{0.0, 0.2}, {0.5, 0.1}, {1.0, 0.02}}) {
    const pattern::Design design = pattern::Mixture{share};
    EXPECT_NEAR(std::log(modulus_at(design, law, 6.17e-2) / modulus_at(design, law, 6.17e-4)) / std::log(100.0),
                exponent, 1e-9);
    EXPECT_DOUBLE_EQ(modulus_at(design, law, kReferenceRatePerS), modulus_at(design, {}, 1.0)) << "the constants' rate";
  }
}

// ISO 527 chords of two Maxwell branches: the relaxed E when slow, both overstresses when fast.
TEST(RateProny, AddsTwoRelaxationTimes) {
  const Extensions law = {{"rate_prony", {0.5, 0.1, 0.3, 100.0}}};
  const pattern::Design rigid = pattern::Mixture{1.0};
  const double relaxed = modulus_at(rigid, {}, 1.0);
  EXPECT_NEAR(modulus_at(rigid, law, 1e-7) / relaxed, 1.0, 0.02);
  EXPECT_NEAR(modulus_at(rigid, law, 1e3) / relaxed, 1.8, 1e-4);
  // At 1e-2 /s the chord lies between 0.05 and 0.25 s: the short branch has half relaxed, the long one has not.
  const auto branch = [](double r, double tau) {
    return r * tau * (std::exp(-0.05 / tau) - std::exp(-0.25 / tau)) / 0.2;
  };
  EXPECT_NEAR(modulus_at(rigid, law, 1e-2) / relaxed, 1.0 + branch(0.5, 0.1) + branch(0.3, 10.0), 1e-9);
}

// Between the exponents of its phases lies that of a layout; equal exponents are one factor.
TEST(RatePowerLaw, ActsInLayoutsThroughTheirPhases) {
  const pattern::Design layout = *pattern::design_from_word("577fffe9fffdef");
  const auto exponent = [&](const Extensions& law) {
    return std::log(modulus_at(layout, law, 6.17e-2) / modulus_at(layout, law, 6.17e-4)) / std::log(100.0);
  };
  EXPECT_NEAR(exponent({{"rate_power_law", {0.1, 1.0, 1.0}}}), 0.1, 1e-6);
  const double mixed = exponent({{"rate_power_law", {0.2, 0.5, 0.1}}});
  EXPECT_GT(mixed, 0.02);
  EXPECT_LT(mixed, 0.2);
}

TEST(BlendLaw, BulgesBetweenTheMaterialsAndNowhereElse) {
  const Extensions law = {{"blend_law", {0.3}}};
  for (const double share : {0.0, 0.5, 1.0})
    EXPECT_EQ(modulus_at(pattern::Mixture{share}, law, 1e-3), modulus_at(pattern::Mixture{share}, {}, 1e-3));
  for (const double share : {0.25, 0.75})
    EXPECT_NEAR(modulus_at(pattern::Mixture{share}, law, 1e-3) / modulus_at(pattern::Mixture{share}, {}, 1e-3),
                std::exp(0.3), 1e-9);
  const pattern::Design layout = *pattern::design_from_word("577fffe9fffdef");
  EXPECT_EQ(modulus_at(layout, law, 1e-3), modulus_at(layout, {}, 1e-3));
}

}  // namespace
}  // namespace nacre::material
