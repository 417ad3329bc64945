#include "tester/paused_pull.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tester/tensile.hpp"

namespace nacre::tester {
namespace {

PausedPull paused(const material::Extensions& extensions, const Loading& loading, double rate_per_s = 1e-2) {
  Simulation simulation{pattern::Mixture{1.0}, material::default_parameters(), {}, Fidelity::tiny};
  simulation.parameters.extensions = extensions;
  simulation.conditions.strain_rate_per_s = rate_per_s;
  return pull_with_pauses(simulation, loading).value();
}

// Closed form at small strain: a ramp of duration T loads the branch by r tau/T (1 - e^(-T/tau)), it decays as it is
// held.
TEST(PausedPull, AMaxwellBranchRelaxesWithItsTime) {
  constexpr double kOverstress = 0.6, kTau = 4.0, kStrain = 1e-4, kRampS = kStrain / 1e-2;
  const PausedPull one = paused({{"rate_dependence", {kOverstress, kTau}}}, {{kStrain}, {6.0}});
  const double loaded = kOverstress * kTau / kRampS * -std::expm1(-kRampS / kTau);
  EXPECT_NEAR(*one.held_stress_pa / one.turn_stress_pa, (1.0 + loaded * std::exp(-6.0 / kTau)) / (1.0 + loaded), 1e-6);
  EXPECT_FALSE(one.set_strain);
}

// A set that recovers is viscous: e^(-t/(tau (1 + r))) at zero force. One that stays is plastic.
TEST(PausedPull, AViscousSetRecoversAndAPlasticOneStays) {
  const Loading loading{{0.02}, {}, 40.0};
  const PausedPull viscous = paused({{"rate_dependence", {0.6, 4.0}}}, loading);
  EXPECT_GT(*viscous.set_strain, 1e-3);
  EXPECT_NEAR(*viscous.dwelled_strain / *viscous.set_strain, std::exp(-40.0 / (4.0 * 1.6)), 2e-3);
  const PausedPull plastic = paused({{"rigid_yield", {2e7}}}, loading);
  EXPECT_GT(*plastic.set_strain, 5e-3);
  EXPECT_NEAR(*plastic.dwelled_strain, *plastic.set_strain, 1e-9);
  const PausedPull elastic = paused({}, loading);
  EXPECT_NEAR(*elastic.set_strain, 0.0, 1e-9);
}

TEST(PausedPull, TurnsWhereAPullWithoutPausesDoes) {
  Simulation simulation{pattern::Mixture{1.0}, material::default_parameters(), {}, Fidelity::tiny};
  simulation.parameters.extensions = {{"rate_dependence", {0.6, 4.0}}};
  const Curve pulled = test_tensile(simulation, {0.0, 0.02}).value();
  EXPECT_NEAR(paused(simulation.parameters.extensions, {{0.02}, {1.0}}, 6.17e-4).turn_stress_pa / pulled.stress_pa[1],
              1.0, 1e-9);
}

TEST(PausedPull, IsRefusedOfLayoutsAndWithoutAStrain) {
  Simulation simulation{
      *pattern::design_from_word("577fffe9fffdef"), material::default_parameters(), {}, Fidelity::tiny};
  EXPECT_FALSE(pull_with_pauses(simulation, {{0.02}, {1.0}}));
  simulation.design = pattern::Mixture{1.0};
  EXPECT_FALSE(pull_with_pauses(simulation, {}));
}

}  // namespace
}  // namespace nacre::tester
