#include "diagnosis/features.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre::diagnosis {
namespace {

/// Rises straight to `peak` at 2 % strain, falls straight to nothing at `end`.
tester::Curve triangle(double peak_pa = 1e7, double end = 0.03) {
  tester::Curve curve;
  for (int i = 0; i <= 100; ++i) {
    const double strain = end * i / 100;
    curve.strain.push_back(strain);
    curve.stress_pa.push_back(strain < 0.02 ? peak_pa * strain / 0.02 : peak_pa * (end - strain) / (end - 0.02));
  }
  return curve;
}

double at(const FeatureValues& values, Feature feature) { return value_of(values, feature).value(); }

TEST(Features, OfATriangleAreThoseOfATriangle) {
  const FeatureValues values = fracture_features(triangle(), {});
  EXPECT_NEAR(at(values, Feature::log_toughness), std::log(0.5 * 1e7 * 0.03), 0.01);
  EXPECT_NEAR(at(values, Feature::log_tangent_30), std::log(1e7 / 0.02), 0.01);
  EXPECT_NEAR(at(values, Feature::log_peak), std::log(1e7), 0.02);
  EXPECT_NEAR(at(values, Feature::toe_strain), 0.0, 1e-5);
  EXPECT_NEAR(at(values, Feature::knee), 0.0, 0.02);
  EXPECT_NEAR(at(values, Feature::tail), 1.0 / 3.0, 0.02);
}

TEST(Features, AFactorOnForceShiftsLogarithmsAndNothingElse) {
  const FeatureValues one = fracture_features(triangle(1e7), {}), two = fracture_features(triangle(2e7), {});
  for (const Feature feature :
       {Feature::log_toughness, Feature::log_tangent_10, Feature::log_tangent_50, Feature::log_peak})
    EXPECT_NEAR(at(two, feature) - at(one, feature), std::log(2.0), 1e-9);
  for (const Feature feature :
       {Feature::toe_strain, Feature::knee, Feature::log_peak_strain, Feature::drop, Feature::tail})
    EXPECT_NEAR(at(two, feature), at(one, feature), 1e-9);
}

TEST(Features, SlackMovesTheToeAndLeavesTheSlopes) {
  tester::Curve slack = triangle();
  for (double& strain : slack.strain) strain += 0.004;
  slack.strain.insert(slack.strain.begin(), 0.0);
  slack.stress_pa.insert(slack.stress_pa.begin(), 0.0);
  const FeatureValues values = fracture_features(slack, {});
  EXPECT_NEAR(at(values, Feature::toe_strain), 0.004, 2e-4);
  EXPECT_NEAR(at(values, Feature::log_tangent_30), std::log(1e7 / 0.02), 0.02);
}

TEST(Features, UnloadingShowsItsSlopeAndThePermanentSet) {
  tester::Curve curve;
  for (int i = 0; i <= 20; ++i) curve.strain.push_back(0.001 * i), curve.stress_pa.push_back(1e6 * i);
  // Down along a line three times as steep: back to nothing at two thirds of the strain.
  for (int i = 1; i <= 20; ++i)
    curve.strain.push_back(0.02 - 0.001 * i / 3.0), curve.stress_pa.push_back(2e7 - 1e6 * i);
  const FeatureValues values = tensile_features(curve, {});
  EXPECT_NEAR(at(values, Feature::log_unloading), std::log(3e9), 1e-6);
  EXPECT_NEAR(at(values, Feature::set_share), 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(at(values, Feature::toe_share), 0.0, 1e-9);
}

// A model without a permanent set goes back less far in stress than the specimen did.
TEST(Features, AnUnloadingThatStopsEarlyHasASlopeToo) {
  const auto back_to = [](double share) {
    tester::Curve curve{{0.0, 0.005, 0.01, 0.015, 0.02}, {0.0, 5e6, 1e7, 1.5e7, 2e7}};
    for (int i = 1; i <= 4; ++i) {
      const double left = 1.0 - (1.0 - share) * i / 4.0;
      curve.strain.push_back(0.02 * left), curve.stress_pa.push_back(2e7 * left);
    }
    return tensile_features(curve, {});
  };
  EXPECT_NEAR(at(back_to(0.7), Feature::log_unloading), std::log(1e9), 1e-6);
  EXPECT_NEAR(at(back_to(0.7), Feature::set_share), 0.0, 1e-9);
  EXPECT_FALSE(value_of(back_to(0.85), Feature::log_unloading));
}

/// Rises straight to 10 MPa at 1 % strain, flows until 3 %, falls to nothing at 3.1 %.
tester::Curve plateau() {
  return {{0.0, 0.0025, 0.005, 0.0075, 0.01, 0.02, 0.03, 0.0305, 0.031},
          {0.0, 2.5e6, 5e6, 7.5e6, 1e7, 9.9e6, 9.8e6, 4e6, 0.0}};
}

TEST(Features, ACouponThatFlowsIsReadWhileItFlows) {
  EXPECT_EQ(carried_strain(plateau(), {}), 0.03);
  const FeatureValues values = tensile_features(tester::cut_at(plateau(), *carried_strain(plateau(), {})), {});
  const double energy = 0.5 * 1e7 * 0.01 + 9.95e6 * 0.01 + 9.85e6 * 0.01;
  EXPECT_NEAR(at(values, Feature::knee), std::log(energy / (0.5 * 1e7 * 0.03)), 1e-9);
  EXPECT_NEAR(at(values, Feature::log_tangent_30), std::log(1e9), 1e-9);
}

TEST(Features, ACouponThatOnlyRisesIsReadToItsEnd) {
  EXPECT_EQ(carried_strain({{0.0, 0.01, 0.02}, {0.0, 1e6, 2e6}}, {}), 0.02);
}

TEST(Features, ACouponUnloadedOnTheWayIsReadWhole) {
  EXPECT_FALSE(carried_strain({{0.0, 0.01, 0.005, 0.02}, {0.0, 1e6, 4e5, 2e6}}, {}).has_value());
}

// Readings of strain waver by a millionth, and a machine springs back when the specimen parts.
TEST(Features, OnlyAFallOfTheStressIsAnUnloading) {
  tester::Curve wavering{{0.0, 0.005, 0.01, 0.01 - 1e-9, 0.015, 0.02}, {0.0, 5e6, 1e7, 1e7, 1.5e7, 2e7}};
  EXPECT_FALSE(is_unloaded(wavering, {}));
  EXPECT_TRUE(carried_strain(wavering, {}).has_value());
  tester::Curve parting = wavering;
  parting.strain.push_back(0.0195), parting.stress_pa.push_back(1e5);
  EXPECT_FALSE(is_unloaded(parting, {}));
  tester::Curve unloaded = wavering;
  for (const double share : {0.9, 0.7, 0.5, 0.3})
    unloaded.strain.push_back(0.02 * share), unloaded.stress_pa.push_back(2e7 * share);
  EXPECT_NEAR(at(tensile_features(unloaded, {}), Feature::log_unloading), std::log(1e9), 1e-6);
}

TEST(Features, ACurveThatNeverRisesSaysNothing) {
  const FeatureValues values = fracture_features({{0.0, 0.01, 0.02, 0.03, 0.04}, {0.0, 0.0, 0.0, 0.0, 0.0}}, {});
  for (const auto& value : values) EXPECT_FALSE(value.has_value());
  EXPECT_FALSE(carried_strain({{0.0, 0.01}, {0.0, -1e6}}, {}).has_value());
}

TEST(Features, NamesReadBack) {
  for (int i = 0; i < kFeatureCount; ++i)
    EXPECT_EQ(feature_from_string(to_string(static_cast<Feature>(i))).value(), static_cast<Feature>(i));
  EXPECT_FALSE(feature_from_string("log_colour").has_value());
}

}  // namespace
}  // namespace nacre::diagnosis
