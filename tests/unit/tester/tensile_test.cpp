#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "material/mixture.hpp"
#include "material/neo_hookean.hpp"
#include "tester/tester.hpp"

namespace nacre::tester {
namespace {

Simulation coupon(double rigid_fraction) {
  return {.design = pattern::Mixture{rigid_fraction},
          .parameters = material::default_parameters(),
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
