#include "game/round_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "base/statistics.hpp"

namespace nacre::game {
namespace {

const std::vector<MeasuredDesign> kFront = {{.round = 1, .mean = {1e9, 0.6e6}}, {.round = 2, .mean = {2e9, 0.3e6}}};

double normal_density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }

/// Of one design over kFront, by the rectangle rule in both logarithms; another way than draws.
double quadrature(const optimize::Performance& predicted, double modulus_sd, double toughness_sd) {
  constexpr int kSteps = 600;
  constexpr double kReach = 6.0, kStep = 2.0 * kReach / kSteps;
  const double front = optimize::hypervolume_staircase_gpa_mpa(std::vector{kFront[0].mean, kFront[1].mean});
  double expected = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = -kReach + (i + 0.5) * kStep, y = -kReach + (j + 0.5) * kStep;
      const std::vector<optimize::Performance> points = {
          kFront[0].mean,
          kFront[1].mean,
          {predicted.modulus_pa * std::exp(modulus_sd * x), predicted.toughness_pa * std::exp(toughness_sd * y)}};
      expected += kStep * kStep * normal_density(x) * normal_density(y) *
                  (optimize::hypervolume_staircase_gpa_mpa(points) - front);
    }
  }
  return expected;
}

TEST(RoundGrowth, ExpectedOfOneDesignIsTheIntegralOverItsErrors) {
  for (const optimize::Performance& predicted :
       {optimize::Performance{1.5e9, 0.5e6}, optimize::Performance{0.9e9, 0.5e6}}) {
    const double exact = quadrature(predicted, 0.1, 0.2);
    const Growth drawn = expected_growth(kFront, std::vector{predicted}, {.of_design = 0.1}, {.of_design = 0.2}, 1);
    EXPECT_NEAR(drawn.mean_gpa_mpa, exact, 4.0 * drawn.error_gpa_mpa / std::sqrt(4000.0));
    EXPECT_GT(exact, 0.0);
    EXPECT_LE(drawn.low_gpa_mpa, drawn.mean_gpa_mpa);
    EXPECT_GE(drawn.high_gpa_mpa, drawn.mean_gpa_mpa);
  }
}

TEST(RoundGrowth, ExpectedWithoutErrorsIsTheHypervolumeItself) {
  // 1.5 GPa x 0.5 MPa adds (1.5 - 1) x (0.5 - 0.3); a dominated design adds nothing.
  const std::vector<optimize::Performance> predicted = {{1.5e9, 0.5e6}, {0.5e9, 0.5e6}};
  const Growth growth = expected_growth(kFront, predicted, {}, {}, 1);
  EXPECT_NEAR(growth.mean_gpa_mpa, 0.1, 1e-12);
  EXPECT_EQ(growth.error_gpa_mpa, 0.0);
}

TEST(RoundGrowth, ABiasOfTheRoundMovesAllItsDesignsTogether) {
  const std::vector<optimize::Performance> predicted = {{1.2e9, 0.45e6}, {1.6e9, 0.4e6}, {1.9e9, 0.35e6}};
  const Growth together = expected_growth(kFront, predicted, {}, {.of_round = 0.2}, 1);
  const Growth apart = expected_growth(kFront, predicted, {}, {.of_design = 0.2}, 1);
  EXPECT_GT(together.error_gpa_mpa, 1.2 * apart.error_gpa_mpa);
}

TEST(RoundGrowth, WhatARoundBroughtIsTheDifferenceOfHypervolumes) {
  std::vector<MeasuredDesign> measured = kFront;
  EXPECT_NEAR(growth_in_round(measured, 1, 1).mean_gpa_mpa, 0.6, 1e-12);
  EXPECT_NEAR(growth_in_round(measured, 2, 1).mean_gpa_mpa, 0.3, 1e-12);
  EXPECT_EQ(growth_in_round(measured, 2, 1).error_gpa_mpa, 0.0);
  measured[1].toughness_error_pa = 0.03e6;
  // The new part is 2 GPa x 0.3 MPa less 1 GPa x 0.3 MPa: 1 GPa x error of T, for T stays below 0.6 MPa.
  EXPECT_NEAR(growth_in_round(measured, 2, 1).error_gpa_mpa, 0.03, 0.002);
  EXPECT_EQ(growth_in_round(measured, 3, 1).mean_gpa_mpa, 0.0) << "nothing was measured in it";
}

TEST(RoundGrowth, ScatterIsThatOfTheMomentsOfTwoRounds) {
  // Rounds of {0.1, 0.3} and {-0.1, 0.1}: within 2 x 0.1^2 + 2 x 0.1^2 over 4 - 2; all squares 0.12 over 4.
  const std::vector<int> rounds = {2, 2, 3, 3};
  const std::vector<double> errors = {0.1, 0.3, -0.1, 0.1};
  const double widening = student_quantile(0.1, 2) / 1.6448536269514722;
  const PredictionScatter scatter = prediction_scatter(rounds, errors);
  EXPECT_NEAR(scatter.of_design, widening * std::sqrt(0.02), 1e-9);
  EXPECT_NEAR(scatter.of_round, widening * std::sqrt(0.03 - 0.02), 1e-9);
}

TEST(RoundGrowth, ScatterOfManyErrorsIsTheOneTheyWereDrawnWith) {
  RandomStream random(7, "errors");
  std::vector<int> rounds;
  std::vector<double> errors;
  for (int round = 2; round < 202; ++round) {
    const double bias = 0.3 * random.normal();
    for (int design = 0; design < 8; ++design) {
      rounds.push_back(round);
      errors.push_back(bias + 0.1 * random.normal());
    }
  }
  const PredictionScatter scatter = prediction_scatter(rounds, errors);
  EXPECT_NEAR(scatter.of_round, 0.3, 0.03);
  EXPECT_NEAR(scatter.of_design, 0.1, 0.005);
}

}  // namespace
}  // namespace nacre::game
