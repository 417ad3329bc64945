#include <gtest/gtest.h>

#include <algorithm>

#include "measurement/observe.hpp"
#include "tester/loading.hpp"
#include "tester/tensile.hpp"

namespace nacre::measurement {
namespace {

/// A rigid coupon that flows, stretched, unloaded and stretched on.
tester::Curve stretched(const std::vector<double>& strain) {
  material::ParameterSet parameters = material::thesis_parameters();
  parameters.extensions["rigid_yield"] = {2.5e7};
  return tester::test_tensile({pattern::Mixture{1.0}, parameters, {}, tester::Fidelity::tiny}, strain).value();
}

std::vector<double> history() { return tester::strain_path({{0.02, 0.005, 0.022}}, 5e-4); }

// What the specimen felt -> what the machine recorded -> what the specimen felt there.
TEST(ObserveAlong, FindsTheStressesBehindWhatTheMachineRecorded) {
  const tester::Curve truth = stretched(history());
  for (const material::Extensions& machine :
       {material::Extensions{{"machine_compliance", {2e-10}}}, material::Extensions{{"toe_slack", {0.002}}},
        material::Extensions{{"machine_compliance", {3e-10}}, {"toe_slack", {0.001}}, {"load_cell_gain", {0.1}}},
        material::Extensions{{"batch_drift", {0.05}}, {"machine_compliance", {1e-10}}}}) {
    const tester::Curve recorded = observe_curve(truth, machine, {.batch_step = 2.0});
    const tester::Curve again = observe_along(recorded.strain, stretched, machine, {.batch_step = 2.0});
    ASSERT_EQ(again.strain, recorded.strain);
    const double peak = *std::max_element(recorded.stress_pa.begin(), recorded.stress_pa.end());
    for (std::size_t i = 0; i < recorded.size(); ++i)
      EXPECT_NEAR(again.stress_pa[i], recorded.stress_pa[i], 2e-3 * peak) << i;
  }
}

TEST(Observe, OneOfTwoMachinesReadsOtherwise) {
  const PrintContext second{.machine = 1};
  const material::Extensions gain = {{"gain_of_one_machine", {0.2}}}, spring = {{"compliance_of_one_machine", {1e-10}}},
                             other_spring = {{"compliance_of_one_machine", {-1e-10}}};
  EXPECT_EQ(observe_modulus(1e9, gain), 1e9);
  EXPECT_NEAR(observe_modulus(1e9, gain, second), 1.2e9, 1.0);
  EXPECT_EQ(observe_modulus(1e9, spring), 1e9);
  EXPECT_NEAR(observe_modulus(1e9, spring, second), 1e9 / 1.1, 1.0);
  EXPECT_NEAR(observe_modulus(1e9, other_spring), 1e9 / 1.1, 1.0);
  EXPECT_EQ(observe_modulus(1e9, other_spring, second), 1e9);
}

// Relative to the first: the second is stiffer, the third has twice as soft a spring.
TEST(Observe, OfThreeMachinesTheStiffestHasNoSpring) {
  const material::Extensions springs = {{"compliance_of_one_machine", {-1e-10, 1e-10}}},
                             gains = {{"gain_of_one_machine", {0.2, -0.1}}};
  EXPECT_EQ(observe_modulus(1e9, springs, {.machine = 1}), 1e9);
  EXPECT_NEAR(1.0 / observe_modulus(1e9, springs, {}), 1e-9 + 1e-10, 1e-16);
  EXPECT_NEAR(1.0 / observe_modulus(1e9, springs, {.machine = 2}), 1e-9 + 2e-10, 1e-16);
  EXPECT_EQ(observe_modulus(1e9, gains, {}), 1e9);
  EXPECT_NEAR(observe_modulus(1e9, gains, {.machine = 2}), 0.9e9, 1.0);
}

TEST(ObserveAlong, IsTheSpecimenItselfWithoutAMachine) {
  EXPECT_EQ(observe_along(history(), stretched, {}), stretched(history()));
}

TEST(ObserveAlong, NothingIsFeltUntilTheSlackIsTakenUp) {
  const tester::Curve shown = observe_along({0.0, 0.001, 0.002, 0.003}, stretched, {{"toe_slack", {0.002}}});
  EXPECT_EQ(shown.stress_pa[0], 0.0);
  EXPECT_EQ(shown.stress_pa[1], 0.0);
  EXPECT_EQ(shown.stress_pa[2], 0.0);
  EXPECT_GT(shown.stress_pa[3], 0.0);
}

}  // namespace
}  // namespace nacre::measurement
