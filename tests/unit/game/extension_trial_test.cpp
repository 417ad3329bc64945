#include "game/extension_trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nacre::game {
namespace {

ExtensionTrialErrors errors_of(const std::vector<double>& adopted, const std::vector<double>& extended,
                               int designs_a_round = 4) {
  ExtensionTrialErrors errors;
  for (std::size_t i = 0; i < adopted.size(); ++i)
    errors.modulus.push_back({.design = "design " + std::to_string(i),
                              .round = 1 + static_cast<int>(i) / designs_a_round,
                              .adopted = adopted[i],
                              .extended = extended[i]});
  return errors;
}

TEST(ExtensionTrial, AGainOnEveryDesignIsEstablished) {
  EXPECT_TRUE(gain_is_established(errors_of({0.11, -0.09, 0.10, -0.12}, {0.01, 0.02, -0.01, 0.02})));
}

// A laminate of which one model expects fifteen times what the other does.
TEST(ExtensionTrial, OneDesignThatSaysEverythingIsEnough) {
  EXPECT_TRUE(gain_is_established(errors_of({2.7, 0.010, -0.015, 0.02}, {0.05, -0.01, 0.02, -0.01})));
}

// Designs on which the adopted model is off by little and by much.
TEST(ExtensionTrial, ErrorsOfDifferentSizeDoNotHideAGain) {
  EXPECT_TRUE(gain_is_established(errors_of({0.60, 0.25, 0.12, 0.31}, {0.01, 0.02, 0.01, 0.01})));
}

TEST(ExtensionTrial, DesignsThatBothPredictSayNothing) {
  EXPECT_FALSE(gain_is_established(errors_of({0.03, -0.02, 0.02, -0.02}, {0.02, -0.02, 0.015, -0.02})));
}

// Both are off by as much to either side: their mean would have done better.
TEST(ExtensionTrial, ModelsThatStraddleTheTruthAreEqual) {
  const ExtensionTrialErrors errors = errors_of({0.05, 0.06, -0.06, 0.07}, {-0.05, -0.04, 0.04, -0.05});
  EXPECT_FALSE(gain_is_established(errors));
}

// An extended model that is far off itself has no claim to a small scatter.
TEST(ExtensionTrial, AnErrorJustSmallerIsNoEvidence) {
  EXPECT_FALSE(gain_is_established(errors_of({0.12, 0.11, -0.12, 0.13}, {0.10, 0.10, -0.10, 0.11})));
}

TEST(ExtensionTrial, TwoDesignsAreTooFew) { EXPECT_FALSE(gain_is_established(errors_of({0.10, 0.10}, {0.01, 0.01}))); }

TEST(ExtensionTrial, ALossIsNoGain) {
  const ExtensionTrialErrors errors = errors_of({0.01, -0.02, 0.01, -0.02}, {0.11, 0.09, -0.10, 0.12});
  EXPECT_FALSE(gain_is_established(errors));
  EXPECT_GT(standing_of(errors.modulus, kLeastModulusError).for_adopted, 1.0);
}

TEST(ExtensionTrial, AShownLossOfToughnessForbidsIt) {
  ExtensionTrialErrors errors = errors_of({0.11, 0.09, 0.10, -0.12}, {0.01, 0.02, -0.01, 0.02});
  for (const OutOfSampleError& each : errors.modulus)
    errors.toughness.push_back({each.design, each.round, 0.1, each.adopted < 0.0 ? -0.6 : 0.6});
  EXPECT_FALSE(gain_is_established(errors));
}

/// How many of 400 games adopt one of two models that are equally wrong about E (or T, ten times as much): three rounds
/// of eight designs, scatter of the measurement 1 %, of each model's own `own`, an offset `common` of each model's in
/// every round. Looked at after each round.
int adopted_of_400(std::vector<OutOfSampleError> ExtensionTrialErrors::*quantity, double own, double common) {
  const double unit = quantity == &ExtensionTrialErrors::toughness ? 10.0 : 1.0;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int adopted = 0;
  for (int game = 0; game < 400; ++game) {
    ExtensionTrialErrors errors;
    bool ever = false;
    for (int round = 1; round <= 3; ++round) {
      const double offset = common * normal(random), other = common * normal(random);
      for (int design = 0; design < 8; ++design) {
        const double scatter = 0.01 * normal(random);
        const double by_adopted = scatter + offset + own * normal(random),
                     by_extended = scatter + other + own * normal(random);
        (errors.*quantity).push_back({"", round, unit * by_adopted, unit * by_extended});
      }
      ever = ever || gain_is_established(errors);
    }
    adopted += ever;
  }
  return adopted;
}

TEST(ExtensionTrial, AModelThatIsNoBetterIsHardlyEverAdopted) {
  for (const auto quantity : {&ExtensionTrialErrors::modulus, &ExtensionTrialErrors::toughness})
    for (const auto& [own, common] : {std::pair{0.005, 0.0}, {0.01, 0.0}, {0.005, 0.01}, {0.01, 0.02}})
      EXPECT_LE(adopted_of_400(quantity, own, common), 20) << own << " " << common;
}

// What acts on fracture alone leaves E as it is.
TEST(ExtensionTrial, AGainInToughnessAloneIsEnough) {
  ExtensionTrialErrors errors;
  const std::vector<double> adopted = {0.5, -0.4, 0.6, -0.5, 0.45}, extended = {0.05, 0.1, -0.08, 0.02, 0.1};
  for (std::size_t i = 0; i < adopted.size(); ++i) {
    errors.toughness.push_back({std::to_string(i), 1, adopted[i], extended[i]});
    errors.modulus.push_back({std::to_string(i), 1, 0.01, 0.01});
  }
  EXPECT_TRUE(gain_is_established(errors));
  for (OutOfSampleError& error : errors.modulus) error.extended = error.design < "2" ? 0.3 : -0.3;
  EXPECT_FALSE(gain_is_established(errors)) << "a loss of E forbids it";
}

// One design a round that both models only extrapolate to, off by a factor of e or more: the less wrong one is not
// right.
TEST(ExtensionTrial, ADesignThatBothAreFarOffHardlyEverDecides) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  constexpr int kGames = 400;
  int adopted = 0;
  for (int game = 0; game < kGames; ++game) {
    ExtensionTrialErrors errors;
    bool ever = false;
    for (int round = 1; round <= 3; ++round) {
      for (int design = 0; design < 8; ++design) {
        const double scatter = 0.01 * normal(random), own = design == 0 ? 1.0 : 0.01;
        errors.modulus.push_back({"", round, scatter + own * normal(random), scatter + own * normal(random)});
      }
      ever = ever || gain_is_established(errors);
    }
    adopted += ever;
  }
  EXPECT_LE(adopted, 3 * kGames / 20);
}

TEST(ExtensionTrial, OnlyDesignsThatBothHadPredictedCount) {
  measurement::Replicates measured;
  measured.design = *pattern::design_from_name("577fffe9fffdef");
  measured.modulus_pa = 1e8;
  measured.toughness_pa = 2e5;
  const std::string name = measured.design.name();
  ExtensionTrialErrors errors;
  errors.add(1, {measured}, {{name, {.modulus_pa = 1.1e8, .toughness_pa = {}, .curve = {}}}}, {});
  EXPECT_TRUE(errors.modulus.empty());
  errors.add(1, {measured}, {{name, {.modulus_pa = 1.1e8, .toughness_pa = {}, .curve = {}}}},
             {{name, {.modulus_pa = 0.9e8, .toughness_pa = 2e5, .curve = {}}}});
  ASSERT_EQ(errors.modulus.size(), 1u);
  EXPECT_NEAR(errors.modulus[0].adopted, std::log(1.1), 1e-12);
  EXPECT_NEAR(errors.modulus[0].extended, std::log(0.9), 1e-12);
  EXPECT_TRUE(errors.toughness.empty()) << "the adopted model had no T";
}

}  // namespace
}  // namespace nacre::game
