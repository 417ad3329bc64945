#include <gtest/gtest.h>

#include "tester/toughness.hpp"

namespace nacre::tester {
namespace {

/// T of a homogeneous specimen whose threshold is met at large strain, so that an unstable step has time to grow.
double toughness(double rigid_fraction, double gamma_per_s, double time_step_scale) {
  Simulation simulation{pattern::Mixture{rigid_fraction}, material::thesis_parameters(), {}, Fidelity::tiny};
  simulation.parameters.toughness.e_tb_pa = 1e6;
  simulation.parameters.toughness.w_tb_j_per_m3 = 3e5;
  simulation.parameters.toughness.gamma_per_s = gamma_per_s;
  Discretisation discretisation;
  discretisation.time_step_scale = time_step_scale;
  return test_toughness(simulation, discretisation).value().toughness_pa;
}

// With alpha = gamma dt above 3/4 the shortest waves grow without bound, and T was 1/500 of what it is. What is left is
// the first-order error of the filter.
TEST(TimeStep, HalvingItHardlyChangesToughnessWhereTheFilterLimitsIt) {
  const double soft = toughness(0.0, 2.828e5, 0.5), rigid = toughness(1.0, 4e6, 0.5);
  EXPECT_NEAR(toughness(0.0, 2.828e5, 1.0), soft, 0.2 * soft);
  EXPECT_NEAR(toughness(1.0, 4e6, 1.0), rigid, 0.2 * rigid);
}

}  // namespace
}  // namespace nacre::tester
