// A solution that leaves the physics - J <= 0 or a value that is not a number - is found within a few steps and
// reported as a reason, never as a number.

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "specimens.hpp"

namespace nacre {
namespace {

using verification::patterns;
using verification::specimen;

/// A tester's specimen some steps into its test, with the thresholds of a tester or without any.
struct Disturbed {
  tester::FractureTest test;
  fem::ExplicitSolver<float> solver;
};

Disturbed pulled_for(int steps, bool thresholds) {
  tester::FractureTest test = tester::fracture_test(specimen(patterns(1)[0]));
  if (!thresholds)
    for (double& threshold : test.grid.threshold_j_per_m3) threshold = std::numeric_limits<double>::infinity();
  auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
  for (int i = 0; i < steps; ++i) solver.step().value();
  return {std::move(test), std::move(solver)};
}

/// The node in the middle of the upper half, away from notch and border.
int inner_node(const tester::FractureTest& test) {
  return (3 * test.grid.rows / 4) * (test.grid.columns + 1) + test.grid.columns / 2;
}

/// Steps until the solver reports an error; fails the test when it does not within `limit`.
int steps_until_reported(fem::ExplicitSolver<float>& solver, int limit) {
  for (int step = 1; step <= limit; ++step)
    if (const auto report = solver.step(); !report) {
      EXPECT_THAT(report.error().message, testing::HasSubstr("blew up"));
      EXPECT_THAT(report.error().message, testing::ContainsRegex("element row [0-9]+ column [0-9]+ at step [0-9]+"));
      return step;
    }
  ADD_FAILURE() << "not found within " << limit << " steps";
  return limit + 1;
}

// A node pushed through the opposite corner of its element. With a tester's thresholds the element passes its own at
// once: found in the first step; without thresholds by the check of every 16th.
TEST(BlowUp, AnInvertedElementIsReportedWithinAFewSteps) {
  for (const bool thresholds : {true, false}) {
    Disturbed d = pulled_for(100, thresholds);
    const int node = inner_node(d.test);
    const Eigen::Vector2d through(1.5 * d.test.grid.element_size_m, 1.5 * d.test.grid.element_size_m);
    d.solver.set_node(node, d.solver.displacement_m(node) + through, Eigen::Vector2d::Zero());
    EXPECT_FALSE(d.solver.check());
    EXPECT_LE(steps_until_reported(d.solver, 16), thresholds ? 1 : 16);
  }
}

// Not a number in position or velocity of one node: no threshold notices it, the check of every 16th step does.
TEST(BlowUp, NotANumberIsReportedWithin16Steps) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const bool thresholds : {true, false})
    for (const bool in_velocity : {false, true}) {
      Disturbed d = pulled_for(100, thresholds);
      const int node = inner_node(d.test);
      const Eigen::Vector2d bad(nan, 0.0), none = Eigen::Vector2d::Zero();
      d.solver.set_node(node, in_velocity ? none : bad, in_velocity ? bad : none);
      steps_until_reported(d.solver, 16);
    }
}

// A time step of twice the stability limit ends as a reason in the tester's own result.
TEST(BlowUp, AnUnstableTestGivesAReasonAndNoNumber) {
  tester::FractureTest test = tester::fracture_test(specimen(pattern::Mixture{1.0}));
  for (double& threshold : test.grid.threshold_j_per_m3) threshold = 1e300;
  test.settings.largest_courant_number = 10.0;
  test.settings.time_step_s = 1.6 * test.grid.element_size_m / fem::fastest_wave_m_per_s(test.grid, 1150.0);
  const auto result = tester::run_fracture_test<float>(test);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, testing::HasSubstr("blew up"));
  EXPECT_THAT(result.error().message, testing::ContainsRegex("element row [0-9]+ column [0-9]+ at step [0-9]+"));
}

// A soft phase that stiffens without bound, in the thesis' ranges: the step for its stiffest state is so short that no
// number of steps that is allowed reaches an end.
TEST(BlowUp, ALawThatNeedsTooManyStepsGivesAReasonAndNoNumber) {
  tester::Simulation simulation = specimen(patterns(1)[0]);
  simulation.fidelity = tester::Fidelity::tiny;
  simulation.parameters.toughness.e_tb_pa = 1e6;
  simulation.parameters.toughness.w_tb_j_per_m3 = 6.6e5;
  simulation.parameters.extensions["soft_stiffening"] = {0.2};
  const auto result = tester::test_toughness(simulation);
  ASSERT_FALSE(result) << result->toughness_pa;
  EXPECT_THAT(result.error().message, testing::HasSubstr("no end after 400000 steps"));
}

/// Pure soft material of the smallest modulus and the largest threshold.
tester::Simulation softest_specimen(double gamma_per_s) {
  tester::Simulation simulation = specimen(pattern::Mixture{0.0});
  simulation.fidelity = tester::Fidelity::tiny;
  simulation.parameters.toughness.e_tb_pa = 1e5;
  simulation.parameters.toughness.w_tb_j_per_m3 = 1e6;
  simulation.parameters.toughness.gamma_per_s = gamma_per_s;
  return simulation;
}

// Stretched to three times its length the softest material carries faster waves than at rest.
TEST(BlowUp, PureSoftMaterialIsPulledAgainWithAShorterStep) {
  const tester::Simulation simulation = softest_specimen(2e4);
  const auto result = tester::test_toughness(simulation),
             half = tester::test_toughness(simulation, {.time_step_scale = 0.5});
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_TRUE(half) << half.error().message;
  EXPECT_NEAR(result->toughness_pa, half->toughness_pa, 0.02 * half->toughness_pa);
}

// The filter's step is so short that the steps allowed end at a quarter of the strain to which pure soft is pulled.
TEST(BlowUp, PureSoftMaterialThatRunsOutOfStepsGivesAReasonAndNoNumber) {
  const tester::Simulation simulation = softest_specimen(3e6);
  const auto result = tester::test_toughness(simulation);
  ASSERT_FALSE(result) << result->toughness_pa << " at strain " << result->failure_strain;
  EXPECT_THAT(result.error().message, testing::AnyOf(testing::HasSubstr("no end after 400000 steps"),
                                                     testing::HasSubstr("the solution blew up")));
}

// A step as short as this law needs would take more samples than fit into memory.
TEST(BlowUp, AStepThatIsNextToNothingGivesAReasonToo) {
  tester::Simulation simulation = specimen(patterns(1)[0]);
  simulation.fidelity = tester::Fidelity::tiny;
  simulation.parameters.toughness.e_tb_pa = 1e6;
  simulation.parameters.toughness.w_tb_j_per_m3 = 1e6;
  simulation.parameters.extensions["soft_stiffening"] = {0.2};
  EXPECT_FALSE(tester::test_toughness(simulation));
}

TEST(BlowUp, ATimeStepBeyondStabilityIsRefused) {
  const auto result = tester::test_toughness(specimen(pattern::Mixture{1.0}), {.time_step_scale = 1.3});
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, testing::HasSubstr("stability limit"));
}

}  // namespace
}  // namespace nacre
