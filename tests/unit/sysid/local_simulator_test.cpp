#include "sysid/local_simulator.hpp"

#include <gtest/gtest.h>

#include "tester/expected_toughness.hpp"

namespace nacre::sysid {
namespace {

std::vector<measurement::Replicates> one_design() {
  std::vector<measurement::Replicates> measured(1);
  measured[0].design = pattern::design_from_name("577fffe9fffdef").value();
  return measured;
}

WantedEvaluation of_specimens(double strength_cv, int first, int count) {
  WantedEvaluation evaluation{
      .id = "1", .parameters = material::thesis_parameters(), .modulus = true, .toughness = true, .items = {0}};
  evaluation.parameters.strength_cv = strength_cv;
  evaluation.first_specimen = first;
  evaluation.specimens = count;
  return evaluation;
}

TEST(LocalSimulator, TIsTheMeanOverSpecimens) {
  LocalSimulator simulator(tester::Fidelity::tiny, 1);
  const std::vector<measurement::Replicates> measured = one_design();
  const Prediction three = simulator.simulate(measured, {of_specimens(0.1, 0, 3)}).at(0).at(0);
  EXPECT_EQ(simulator.simulations(), 4) << "a modulus and three specimens";
  const WantedEvaluation evaluation = of_specimens(0.1, 0, 3);
  const tester::Simulation simulation{measured[0].design, evaluation.parameters, measured[0].conditions,
                                      tester::Fidelity::tiny};
  const tester::ExpectedToughness expected = tester::expected_toughness(simulation, 3).value();
  EXPECT_DOUBLE_EQ(*three.toughness_pa, expected.toughness_pa);
  const Prediction third = simulator.simulate(measured, {of_specimens(0.1, 2, 1)}).at(0).at(0);
  EXPECT_EQ(simulator.simulations(), 4) << "it was among them";
  EXPECT_EQ(*third.toughness_pa, expected.specimens[2].toughness_pa);
}

TEST(LocalSimulator, BreaksOneOfAlikeSpecimens) {
  LocalSimulator simulator(tester::Fidelity::tiny, 1);
  (void)simulator.simulate(one_design(), {of_specimens(0.0, 5, 8)});
  EXPECT_EQ(simulator.simulations(), 2);
}

}  // namespace
}  // namespace nacre::sysid
