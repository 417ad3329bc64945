#include "sysid/objective.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sysid/errors.hpp"
#include "sysid/weights.hpp"

namespace nacre::sysid {
namespace {

using measurement::Replicates;

Replicates measured(double modulus_pa, double toughness_pa) {
  Replicates design;
  design.modulus_count = modulus_pa > 0.0 ? 1 : 0;
  design.modulus_pa = modulus_pa;
  design.toughness_count = toughness_pa > 0.0 ? 1 : 0;
  design.toughness_pa = toughness_pa;
  return design;
}

Prediction predicted(std::optional<double> modulus_pa, std::optional<double> toughness_pa) {
  return {.modulus_pa = modulus_pa, .toughness_pa = toughness_pa, .curve = {}};
}

TEST(PredictionErrors, AreRelativeToTheMeasurement) {
  const PredictionErrors errors =
      prediction_errors({measured(2.0, 4.0), measured(1.0, 0.0), measured(0.0, 1.0)},
                        {predicted(1.0, 5.0), predicted(1.1, 7.0), predicted(9.0, std::nullopt)});
  EXPECT_EQ(errors.modulus_count, 2);
  EXPECT_DOUBLE_EQ(errors.modulus_mean, 0.3);
  EXPECT_DOUBLE_EQ(errors.modulus_max, 0.5);
  EXPECT_EQ(errors.toughness_count, 1);
  EXPECT_DOUBLE_EQ(errors.toughness_mean, 0.25);
  EXPECT_EQ(errors.toughness_spearman, 0.0);  // one pair has no rank
}

TEST(PredictionErrors, RankCorrelationSharesTiedRanks) {
  const auto spearman = [](std::vector<double> a, std::vector<double> b) {
    std::vector<Replicates> designs;
    std::vector<Prediction> predictions;
    for (std::size_t i = 0; i < a.size(); ++i) {
      designs.push_back(measured(0.0, a[i]));
      predictions.push_back(predicted(std::nullopt, b[i]));
    }
    return prediction_errors(designs, predictions).toughness_spearman;
  };
  EXPECT_DOUBLE_EQ(spearman({1, 2, 3, 4}, {1, 10, 100, 1000}), 1.0);
  EXPECT_DOUBLE_EQ(spearman({1, 2, 3, 4}, {9, 8, 2, 1}), -1.0);
  EXPECT_DOUBLE_EQ(spearman({1, 2, 3}, {5, 5, 5}), 0.0);
  // Ranks 1, 2.5, 2.5, 4 against 1, 3, 2, 4: 4.5 / sqrt(4.5 * 5).
  EXPECT_NEAR(spearman({1, 2, 2, 4}, {1, 3, 2, 4}), 4.5 / std::sqrt(4.5 * 5.0), 1e-12);
}

TEST(SampleWeights, FallWithTheDistanceFromTheFrontAsInEquation29) {
  // Eleven designs on the line from (0, 1) to (1, 0) of the unit square, and one `distance` below its middle.
  const auto weight_at = [](double distance) {
    std::vector<Replicates> designs;
    for (int k = 0; k <= 10; ++k) designs.push_back(measured(1.0 + 0.1 * k, 2.0 - 0.1 * k));
    const double x = 0.5 - distance / std::sqrt(2.0);
    designs.push_back(measured(1.0 + x, 1.0 + x));
    return sample_weights(designs).back();
  };
  EXPECT_DOUBLE_EQ(weight_at(0.1), 1.0);
  EXPECT_DOUBLE_EQ(weight_at(0.19), 1.0);
  EXPECT_NEAR(weight_at(0.4), 0.6, 1e-9);
  EXPECT_NEAR(weight_at(0.6), 0.2, 1e-9);
  EXPECT_NEAR(weight_at(0.65), 0.2, 1e-9);
}

TEST(SampleWeights, CrowdedDesignsShareTheThresholdOfEquation211) {
  std::vector<Replicates> designs = {measured(1.0, 2.0), measured(2.0, 1.0)};
  for (int copy = 0; copy < 5; ++copy) designs.push_back(measured(1.5, 1.5));
  const std::vector<double> weights = sample_weights(designs);
  EXPECT_NEAR(weights[0], 1.0, 1e-12);
  EXPECT_NEAR(weights[2], 2.0 / 5.0, 1e-12);  // density 5, the corners being exp(-100) away
}

TEST(SampleWeights, DesignsWithOneValueCountFully) {
  const std::vector<double> weights = sample_weights({measured(1.0, 0.0), measured(0.0, 1.0), measured(2.0, 2.0)});
  EXPECT_EQ(weights, (std::vector<double>{1.0, 1.0, 1.0}));
}

TEST(SampleWeights, FrontIsClosedByLinesToTheAxes) {
  // A design level with the best toughness, at half the modulus, is on the closed front.
  const std::vector<double> weights =
      sample_weights({measured(2.0, 2.0), measured(1.0, 1.9), measured(1.5, 1.0), measured(0.9, 0.9)});
  EXPECT_EQ(weights[1], 1.0);
}

TEST(Objective, WeightsAreNormalised) {
  const std::vector<Replicates> designs = {measured(2.0, 4.0), measured(1.0, 1.0)};
  const std::vector<Prediction> predictions = {predicted(1.0, 5.0), predicted(1.0, 1.0)};
  for (const double scale : {1.0, 7.0}) {
    EXPECT_DOUBLE_EQ(modulus_objective(designs, {scale, 3.0 * scale}, predictions), 0.125);
    EXPECT_DOUBLE_EQ(toughness_objective(designs, {scale, scale}, predictions), 0.125);
  }
}

TEST(Objective, FailedSimulationIsAnErrorOfOne) {
  Replicates design = measured(2.0, 4.0);
  EXPECT_DOUBLE_EQ(modulus_objective({design}, {1.0}, {{}}), 1.0);
  EXPECT_DOUBLE_EQ(toughness_objective({design}, {1.0}, {{}}), 1.0);
  design.representative_curve = {{0.0, 1.0, 2.0}, {0.0, 4.0, 0.0}};  // area 4
  EXPECT_DOUBLE_EQ(toughness_objective({design}, {1.0}, {{}}), 2.0);
}

TEST(Objective, CurveTermIsTheAreaBetweenTheCurves) {
  Replicates design = measured(0.0, 4.0);
  design.representative_curve = {{0.0, 1.0, 2.0}, {0.0, 4.0, 0.0}};
  Prediction same = predicted(std::nullopt, 4.0);
  same.curve = design.representative_curve;
  EXPECT_NEAR(toughness_objective({design}, {1.0}, {same}), 0.0, 1e-12);
  Prediction half = same;
  for (double& stress : half.curve.stress_pa) stress *= 0.5;
  EXPECT_NEAR(toughness_objective({design}, {1.0}, {half}), 0.5, 1e-12);  // T agrees, half of the area does not
}

TEST(ForwardPart, LeavesOutUnloading) {
  const tester::Curve curve = {{0.0, 0.1, 0.2, 0.15, 0.2, 0.3}, {0.0, 1.0, 2.0, 1.0, 2.0, 3.0}};
  EXPECT_EQ(forward_part(curve), (tester::Curve{{0.0, 0.1, 0.2, 0.3}, {0.0, 1.0, 2.0, 3.0}}));
}

TEST(Observed, IsThePredictionItselfWithoutExtensions) {
  Prediction prediction = predicted(1.23e9, 4.56e5);
  prediction.curve = {{0.0, 0.01, 0.02}, {0.0, 1e6, 0.0}};
  const Prediction shown = observed(prediction, {});
  EXPECT_EQ(shown.modulus_pa, prediction.modulus_pa);
  EXPECT_EQ(shown.toughness_pa, prediction.toughness_pa);
  EXPECT_EQ(shown.curve, prediction.curve);
}

}  // namespace
}  // namespace nacre::sysid
