#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "material/mixture.hpp"
#include "material/neo_hookean.hpp"
#include "tester/modulus.hpp"
#include "tester/tensile.hpp"

namespace nacre::tester {
namespace {

Simulation coupon(double rigid_fraction) {
  return {.design = pattern::Mixture{rigid_fraction},
          .parameters = material::thesis_parameters(),
          .conditions = {},
          .fidelity = Fidelity::full};
}

TEST(Tensile, FollowsTheClosedFormWithoutLateralCoupling) {
  Simulation simulation = coupon(1.0);
  simulation.parameters.modulus.nu_vw = 0.0;  // then P = mu (F - 1/F) with mu = E/2
  const std::vector<double> history = {0.0, 1e-4, 0.02, 0.3, 1.0};
  const Result<Curve> curve = test_tensile(simulation, history);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->strain, history);
  for (std::size_t i = 0; i < history.size(); ++i) {
    const double stretch = 1.0 + history[i];
    EXPECT_NEAR(curve->stress_pa[i], 0.5 * simulation.parameters.modulus.e_vw_pa * (stretch - 1.0 / stretch), 1e-6);
  }
}

TEST(Tensile, StartsWithTheModulusOfTheModulusTester) {
  for (const double fraction : {0.0, 0.3, 0.5, 0.85, 1.0}) {
    const Result<Curve> curve = test_tensile(coupon(fraction), {1e-4});
    const Result<ModulusResult> modulus = test_modulus(coupon(fraction));
    ASSERT_TRUE(curve && modulus);
    EXPECT_NEAR(curve->stress_pa[0] / 1e-4, modulus->modulus_pa, 1e-9 * modulus->modulus_pa);
    const double young = material::mixture(material::phases_of(coupon(0).parameters.modulus), fraction).young_pa;
    EXPECT_NEAR(modulus->modulus_pa, young, 3e-4 * young);  // the secant at a strain of 1e-4
  }
}

TEST(Tensile, UnloadingRetracesLoading) {
  const Result<Curve> curve = test_tensile(coupon(0.7), {0.0, 0.01, 0.02, 0.01, 0.0});
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->stress_pa[1], curve->stress_pa[3]);
  EXPECT_EQ(curve->stress_pa[0], 0.0);
  EXPECT_EQ(curve->stress_pa[4], 0.0);
}

Simulation extended_coupon(double rigid_fraction, material::Extensions extensions) {
  Simulation simulation = coupon(rigid_fraction);
  simulation.parameters.extensions = std::move(extensions);
  return simulation;
}

TEST(Tensile, WithWeakExtensionsIsNearTheBaseCoupon) {
  const std::vector<double> history = {0.0, 0.01, 0.02, 0.01, 0.0};
  const Curve base = test_tensile(coupon(0.8), history).value();
  const Curve weak = test_tensile(extended_coupon(0.8, {{"rate_dependence", {1e-9, 1.0}}}), history).value();
  for (std::size_t i = 0; i < history.size(); ++i)
    EXPECT_NEAR(weak.stress_pa[i], base.stress_pa[i], 1e-6 * base.stress_pa[2]) << i;
}

// Softening keeps the largest strain, limited chains forget every one: no small steps are needed on the way.
TEST(Tensile, ALawWithoutAPathNeedsNoSmallSteps) {
  const material::Extensions laws = {{"soft_stiffening", {1.0}}, {"progressive_damage", {1.0}}};
  std::vector<double> small;
  for (int i = 1; i <= 900; ++i) small.push_back(1e-3 * std::min(i, 1200 - i));
  const Curve followed = test_tensile(extended_coupon(0.2, laws), small).value(),
              ends = test_tensile(extended_coupon(0.2, laws), {0.6, 0.3}).value();
  EXPECT_NEAR(ends.stress_pa[0], followed.stress_pa[599], 1e-9 * followed.stress_pa[599]);
  EXPECT_NEAR(ends.stress_pa[1], followed.stress_pa.back(), 1e-9 * followed.stress_pa[599]);
}

TEST(Tensile, YieldsAndKeepsASetOnUnloading) {
  const Curve curve =
      test_tensile(extended_coupon(1.0, {{"rigid_yield", {4e7}}}), {0.01, 0.03, 0.05, 0.035, 0.03}).value();
  EXPECT_NEAR(curve.stress_pa[1] * 1.03, 4e7, 1.0);
  EXPECT_NEAR(curve.stress_pa[2] * 1.05, 4e7, 1.0);
  EXPECT_LT(curve.stress_pa[3], 0.2 * 4e7);
  EXPECT_LT(curve.stress_pa[4], 0.0) << "pushed back beyond its set";
}

TEST(Tensile, StiffensLateWhereTheSoftPhaseIsAndNowhereElse) {
  const auto ratio = [](double rigid_fraction, double strain) {
    const double base = test_tensile(coupon(rigid_fraction), {strain}).value().stress_pa[0];
    return test_tensile(extended_coupon(rigid_fraction, {{"soft_stiffening", {1.0}}}), {strain}).value().stress_pa[0] /
           base;
  };
  EXPECT_GT(ratio(0.0, 0.4), 1.2);
  EXPECT_NEAR(ratio(0.0, 1e-3), 1.0, 3e-3);
  EXPECT_GT(ratio(0.0, 0.4), ratio(0.25, 0.4));
  EXPECT_NEAR(ratio(1.0, 0.1), 1.0, 1e-6);
}

TEST(Tensile, RelaxesInRealTime) {
  Simulation slow = extended_coupon(1.0, {{"rate_dependence", {0.5, 20.0}}}), fast = slow;
  slow.conditions.strain_rate_per_s = 1e-7;
  fast.conditions.strain_rate_per_s = 1e2;
  const double relaxed = test_tensile(coupon(1.0), {0.01}).value().stress_pa[0];
  EXPECT_NEAR(test_tensile(slow, {0.01}).value().stress_pa[0] / relaxed, 1.0, 1e-3);
  EXPECT_NEAR(test_tensile(fast, {0.01}).value().stress_pa[0] / relaxed, 1.5, 1e-3);
}

TEST(Tensile, SoftensFromTheThresholdOfTheToughnessTable) {
  Simulation simulation = extended_coupon(1.0, {{"progressive_damage", {1.0}}});
  const double young = simulation.parameters.modulus.e_vw_pa, threshold = simulation.parameters.toughness.w_vw_j_per_m3;
  const double first = std::sqrt(2.0 * threshold / young);
  std::vector<double> history;
  for (int i = 1; i <= 60; ++i) history.push_back(0.05 * i * first);
  const Curve curve = test_tensile(simulation, history).value();
  const auto peak = std::max_element(curve.stress_pa.begin(), curve.stress_pa.end()) - curve.stress_pa.begin();
  EXPECT_NEAR(history[peak] / first, 1.0, 0.1);
  EXPECT_EQ(curve.stress_pa.back(), 0.0);
  EXPECT_NEAR(area_under(curve) / (2.0 * threshold), 1.0, 0.05);
}

TEST(Tensile, ShrunkCouponsAreMeasuredAsTheyAre) {
  const std::vector<double> history = {0.0, 0.01};
  EXPECT_EQ(test_tensile(extended_coupon(1.0, {{"residual_strain", {0.01}}}), history).value(),
            test_tensile(coupon(1.0), history).value());
}

TEST(Tensile, RefusesPatternsAndImpossibleStrains) {
  Simulation simulation = coupon(0.5);
  EXPECT_FALSE(test_tensile(simulation, {0.0, -1.0}));
  simulation.design = pattern::design_from_name("577fffe9fffdef").value();
  const Result<Curve> curve = test_tensile(simulation, {0.0});
  ASSERT_FALSE(curve);
  EXPECT_THAT(curve.error().message, ::testing::HasSubstr("577fffe9fffdef is not homogeneous"));
}

TEST(Modulus, UnusableQuestionsAreErrorsThatSayWhy) {
  Simulation simulation = coupon(0.5);
  simulation.conditions.orientation_deg = 45.0;
  EXPECT_THAT(test_modulus(simulation).error().message,
              ::testing::HasSubstr("orientation 45 degrees, expected 0 or 90"));
  simulation = coupon(0.5);
  simulation.parameters.modulus.e_if_pa = -1.0;
  EXPECT_THAT(test_modulus(simulation).error().message, ::testing::HasSubstr("modulus.e_if_pa = -1"));
  simulation = coupon(0.5);
  simulation.parameters.toughness.e_if_pa = -1.0;  // not this test's business
  EXPECT_TRUE(test_modulus(simulation));
}

}  // namespace
}  // namespace nacre::tester
