#include "tester/modulus_probe.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pattern/design.hpp"
#include "tester/modulus.hpp"

namespace nacre::tester {
namespace {

Simulation specimen(const material::Extensions& extensions = {}) {
  Simulation simulation{
      *pattern::design_from_name("577fffe9fffdef"), material::thesis_parameters(), {}, Fidelity::tiny};
  simulation.parameters.extensions = extensions;
  return simulation;
}

double modulus_at(Simulation simulation, const material::ParameterSet& parameters) {
  simulation.parameters = parameters;
  return test_modulus(simulation).value().modulus_pa;
}

TEST(ModulusProbe, AtItsOwnParametersIsTheTester) {
  const Simulation simulation = specimen();
  const auto probe = ModulusProbe::at(simulation);
  ASSERT_TRUE(probe) << probe.error().message;
  EXPECT_EQ(probe->modulus_pa(), test_modulus(simulation).value().modulus_pa);
  EXPECT_EQ(probe->nearby(simulation.parameters), probe->modulus_pa());
}

// Halving the change divides the error by four.
TEST(ModulusProbe, IsExactToFirstOrderInEveryConstant) {
  const Simulation simulation = specimen({{"droplet_mixing", {0.8}}, {"interface_anisotropy", {0.2}}});
  const auto probe = ModulusProbe::at(simulation);
  ASSERT_TRUE(probe);
  for (double material::ModulusParameters::*constant :
       {&material::ModulusParameters::e_tb_pa, &material::ModulusParameters::e_vw_pa,
        &material::ModulusParameters::e_if_pa}) {
    std::vector<double> errors;
    for (const double change : {0.04, 0.02}) {
      material::ParameterSet moved = simulation.parameters;
      moved.modulus.*constant *= 1.0 + change;
      const double exact = modulus_at(simulation, moved);
      errors.push_back(probe->nearby(moved) / exact - 1.0);
      EXPECT_GE(errors.back(), -1e-9) << "the displacements of others hold at least as much energy";
    }
    EXPECT_LT(errors[0], 1e-3);
    EXPECT_NEAR(errors[1], errors[0] / 4.0, 0.2 * errors[0] + 1e-9);
  }
}

TEST(ModulusProbe, KnowsTheSlopeOfAnEffect) {
  const Simulation simulation = specimen({{"interface_anisotropy", {0.2}}});
  const auto probe = ModulusProbe::at(simulation);
  ASSERT_TRUE(probe);
  material::ParameterSet moved = simulation.parameters;
  moved.extensions["interface_anisotropy"] = {0.21};
  const double exact = std::log(modulus_at(simulation, moved) / probe->modulus_pa());
  EXPECT_NEAR(std::log(probe->nearby(moved) / probe->modulus_pa()), exact, 0.05 * std::abs(exact));
}

TEST(ModulusProbe, HomogeneousDesignsAreRefused) {
  Simulation simulation = specimen();
  simulation.design = pattern::Mixture{0.5};
  EXPECT_FALSE(ModulusProbe::at(simulation));
}

}  // namespace
}  // namespace nacre::tester
