// Extensions of elastic tests: how stiffness goes with the rate, and blends beside the mixture law.

#include <gtest/gtest.h>

#include <cmath>

#include "material/blend_law.hpp"
#include "material/rate_laws.hpp"
#include "tester/modulus.hpp"
#include "tester/relaxation.hpp"

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

// Between soft phase and interface a blend takes up a mean of their overstresses, and no other phase any.
TEST(RateByPhase, EveryPhaseHasItsOverstress) {
  const Extensions law = {{"rate_by_phase", {0.8, 5.0, 0.5, 0.0}}};
  for (const auto& [share, overstress] : {std::pair{0.0, 0.8}, {0.25, 0.6}, {0.5, 0.4}, {0.75, 0.2}, {1.0, 0.0}}) {
    const pattern::Design design = pattern::Mixture{share};
    const double relaxed = modulus_at(design, {}, 1.0);
    EXPECT_NEAR(modulus_at(design, law, 1e3) / relaxed, 1.0 + overstress, 1e-4);
    EXPECT_NEAR(modulus_at(design, law, 1e-8) / relaxed, 1.0, 1e-2);
  }
  const pattern::Design layout = *pattern::design_from_word("577fffe9fffdef");
  const double grown = modulus_at(layout, law, 1e3) / modulus_at(layout, {}, 1.0);
  EXPECT_GT(grown, 1.0);
  EXPECT_LT(grown, 1.8);
}

// Of equal overstresses it is rate_dependence.
TEST(RateByPhase, OfAllPhasesAlikeIsOneMaxwellBranch) {
  for (const pattern::Design& design :
       {*pattern::design_from_word("577fffe9fffdef"), pattern::Design(pattern::Mixture{0.3})}) {
    EXPECT_NEAR(modulus_at(design, {{"rate_by_phase", {0.8, 5.0, 1.0, 1.0}}}, 1e-3) /
                    modulus_at(design, {{"rate_dependence", {0.8, 5.0}}}, 1e-3),
                1.0, 1e-9);
  }
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

double relaxation_at(const pattern::Design& design, const Extensions& extensions, double time_s) {
  tester::Simulation simulation{design, default_parameters(), {}, tester::Fidelity::tiny};
  simulation.parameters.extensions = extensions;
  return tester::relaxation_modulus(simulation, time_s).value();
}

// A branch that took up stress at once decays with its own time.
TEST(RelaxationModulus, OfAMaxwellBranchDecaysExponentially) {
  const pattern::Design rigid = pattern::Mixture{1.0};
  const double relaxed = modulus_at(rigid, {}, 1.0);
  for (const double time_s : {0.1, 2.0, 5.0})
    EXPECT_NEAR(relaxation_at(rigid, {{"rate_dependence", {0.6, 2.0}}}, time_s) / relaxed,
                1.0 + 0.6 * std::exp(-time_s / 2.0), 1e-12);
}

// Boltzmann: a pull's stress is its rate times the integral of the relaxation modulus, so that the chord from 0.05 to
// 0.25 % is the mean of that modulus over the times between.
TEST(RelaxationModulus, OfEveryLawIntegratesToTheChordOfAPull) {
  constexpr int kIntervals = 2000;
  const Extensions laws[] = {{{"rate_dependence", {0.6, 2.0}}},
                             {{"rate_power_law", {0.4, 0.5, 0.1}}},
                             {{"rate_by_phase", {0.6, 2.0, 0.5, 0.2}}},
                             {{"rate_prony", {0.5, 0.1, 0.3, 100.0}}}};
  for (const Extensions& law : laws) {
    for (const double share : {0.0, 0.25, 1.0}) {
      for (const double rate_per_s : {1e-4, 1e-2}) {
        const pattern::Design design = pattern::Mixture{share};
        double mean = 0.0;
        for (int i = 0; i < kIntervals; ++i)
          mean += relaxation_at(design, law, (0.0005 + 0.002 * (i + 0.5) / kIntervals) / rate_per_s) / kIntervals;
        EXPECT_NEAR(mean / modulus_at(design, law, rate_per_s), 1.0, share == 0.25 ? 2e-3 : 1e-5)
            << law.begin()->first << " " << share << " " << rate_per_s;
      }
    }
  }
}

// The rate that stands for a time where a material relaxes slowly.
TEST(RelaxationModulus, AfterATimeIsThatOfAPullAtTheRateThatStandsForIt) {
  const pattern::Design soft = pattern::Mixture{0.0};
  for (const double exponent : {0.01, 0.1, 0.3})
    EXPECT_NEAR(relaxation_at(soft, {{"rate_power_law", {exponent, 1.0, 1.0}}}, 30.0) /
                    modulus_at(soft, {{"rate_power_law", {exponent, 1.0, 1.0}}}, kRelaxationStrain / 30.0),
                1.0, 0.05 * exponent);
}

TEST(RelaxationModulus, IsRefusedOfLayoutsAndAtNoTime) {
  tester::Simulation simulation{
      *pattern::design_from_word("577fffe9fffdef"), default_parameters(), {}, tester::Fidelity::tiny};
  EXPECT_FALSE(tester::relaxation_modulus(simulation, 1.0));
  simulation.design = pattern::Mixture{1.0};
  EXPECT_TRUE(tester::relaxation_modulus(simulation, 1.0));
  EXPECT_FALSE(tester::relaxation_modulus(simulation, 0.0));
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
