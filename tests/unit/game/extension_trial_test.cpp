#include "game/extension_trial.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre::game {
namespace {

// Two-sided 5 % and one-sided 1 % points of printed tables.
TEST(Student, ExceedanceIsThatOfTheTables) {
  EXPECT_NEAR(student_exceedance(12.706, 1), 0.025, 1e-5);
  EXPECT_NEAR(student_exceedance(4.303, 2), 0.025, 1e-5);
  EXPECT_NEAR(student_exceedance(3.182, 3), 0.025, 1e-5);
  EXPECT_NEAR(student_exceedance(3.747, 4), 0.010, 1e-5);
  EXPECT_NEAR(student_exceedance(2.998, 7), 0.010, 1e-5);
  EXPECT_NEAR(student_exceedance(-2.998, 7), 0.990, 1e-5);
  EXPECT_NEAR(student_exceedance(0.0, 5), 0.5, 1e-12);
}

TrialErrors errors_of(const std::vector<double>& adopted, const std::vector<double>& extended) {
  TrialErrors errors;
  for (std::size_t i = 0; i < adopted.size(); ++i)
    errors.modulus.push_back({"design " + std::to_string(i), adopted[i], extended[i]});
  return errors;
}

TEST(ExtensionTrial, AGainOnEveryDesignIsEstablished) {
  EXPECT_TRUE(gain_is_established(errors_of({0.11, 0.09, 0.10, 0.12}, {0.01, 0.02, 0.01, 0.02}), 3));
}

TEST(ExtensionTrial, OneLuckyDesignEstablishesNothing) {
  EXPECT_FALSE(gain_is_established(errors_of({0.30, 0.02, 0.02, 0.02}, {0.01, 0.02, 0.03, 0.02}), 3));
}

// Designs on which the adopted model is off by little and by much: what counts is how many times smaller the error is.
TEST(ExtensionTrial, ErrorsOfDifferentSizeDoNotHideAGain) {
  EXPECT_TRUE(gain_is_established(errors_of({0.60, 0.25, 0.12, 0.31}, {0.01, 0.02, 0.01, 0.01}), 3));
}

TEST(ExtensionTrial, TwoDesignsAreTooFew) {
  EXPECT_FALSE(gain_is_established(errors_of({0.10, 0.10}, {0.01, 0.01}), 1));
}

TEST(ExtensionTrial, ALossIsNoGain) {
  EXPECT_FALSE(gain_is_established(errors_of({0.01, 0.02, 0.01, 0.02}, {0.11, 0.09, 0.10, 0.12}), 3));
}

// The more rounds may try, the stronger the evidence has to be.
TEST(ExtensionTrial, TheLevelIsSharedByTheRounds) {
  const TrialErrors errors = errors_of({0.05, 0.03, 0.08, 0.04}, {0.02, 0.01, 0.02, 0.03});
  EXPECT_TRUE(gain_is_established(errors, 1));
  EXPECT_FALSE(gain_is_established(errors, 20));
}

TEST(ExtensionTrial, AShownLossOfToughnessForbidsIt) {
  TrialErrors errors = errors_of({0.11, 0.09, 0.10, 0.12}, {0.01, 0.02, 0.01, 0.02});
  for (const ForetoldError& each : errors.modulus) errors.toughness.push_back({each.design, 0.1, each.adopted + 0.4});
  EXPECT_FALSE(gain_is_established(errors, 3));
}

TEST(ExtensionTrial, OnlyDesignsThatBothHadForetoldCount) {
  measurement::Replicates measured;
  measured.design = *pattern::design_from_name("577fffe9fffdef");
  measured.modulus_pa = 1e8;
  measured.toughness_pa = 2e5;
  const std::string name = measured.design.name();
  TrialErrors errors;
  errors.add({measured}, {{name, {.modulus_pa = 1.1e8, .toughness_pa = {}, .curve = {}}}}, {});
  EXPECT_TRUE(errors.modulus.empty());
  errors.add({measured}, {{name, {.modulus_pa = 1.1e8, .toughness_pa = {}, .curve = {}}}},
             {{name, {.modulus_pa = 0.9e8, .toughness_pa = 2e5, .curve = {}}}});
  ASSERT_EQ(errors.modulus.size(), 1u);
  EXPECT_NEAR(errors.modulus[0].adopted, std::log(1.1), 1e-12);
  EXPECT_NEAR(errors.modulus[0].extended, -std::log(0.9), 1e-12);
  EXPECT_TRUE(errors.toughness.empty()) << "the adopted model had no T";
}

}  // namespace
}  // namespace nacre::game
