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

class PowerOfTime : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Exponents, PowerOfTime, testing::Values(0.03, 0.2, 0.55));

// A ramp of duration T loads by the integral of G ~ t^-n: held for t, ((T + t)^(1-n) - t^(1-n)) / T^(1-n) are left.
TEST_P(PowerOfTime, RelaxesAfterARampAsItsClosedForm) {
  const double n = GetParam(), rest = 1.0 - n;
  constexpr double kStrain = 1e-4;
  for (const double ratio : {0.1, 6.0, 1e4}) {
    const double ramp_s = kStrain / 1e-2, held_s = ratio * ramp_s;
    const PausedPull one = paused({{"rate_power_law", {n, 1.0, 1.0}}}, {{kStrain}, {held_s}});
    const double left = std::pow(ramp_s + held_s, rest) - std::pow(held_s, rest);
    EXPECT_NEAR(*one.held_stress_pa / one.turn_stress_pa / (left / std::pow(ramp_s, rest)), 1.0, 1e-4) << ratio;
  }
}

// The chord of a modulus test grows as the rate to the power n.
TEST_P(PowerOfTime, PullsWithTheModulusOfItsRate) {
  const double n = GetParam();
  const auto chord_pa = [](double rate_per_s, const material::Extensions& extensions) {
    Simulation simulation{pattern::Mixture{0.8}, material::default_parameters(), {}, Fidelity::tiny};
    simulation.parameters.extensions = extensions;
    simulation.conditions.strain_rate_per_s = rate_per_s;
    const Curve curve = test_tensile(simulation, {0.0, 0.0005, 0.001, 0.0015, 0.002, 0.0025}).value();
    return (curve.stress_pa[5] - curve.stress_pa[1]) / 0.002;
  };
  for (const double faster : {0.01, 1.0, 1e3})
    EXPECT_NEAR(
        chord_pa(faster * 6.17e-4, {{"rate_power_law", {n, 1.0, 1.0}}}) / chord_pa(6.17e-4, {}) / std::pow(faster, n),
        1.0, 5e-3)
        << "neo-Hookean stress bends over 0.25 % of strain";
}

// All of it comes back: after T up and T down at zero stress a springpot's set falls to nothing with time.
TEST_P(PowerOfTime, RecoversWithoutForce) {
  const double n = GetParam();
  const auto left_after = [n](double dwell_s) {
    return *paused({{"rate_power_law", {n, 1.0, 1.0}}}, {{0.01}, {10.0}, dwell_s}).dwelled_strain / 0.01;
  };
  EXPECT_GT(left_after(1.0), left_after(100.0));
  EXPECT_LT(left_after(1e6), 0.4 * left_after(1.0));
  EXPECT_GT(left_after(1e6), 0.0);
}

// The rigid phase here: the second number of its two.
TEST(PausedPull, ABranchByPhaseRelaxesAsOneOfAll) {
  const Loading loading{{0.02}, {6.0}, 40.0};
  const PausedPull one = paused({{"rate_by_phase", {0.8, 4.0, 1.0, 0.5}}}, loading),
                   all = paused({{"rate_dependence", {0.4, 4.0}}}, loading);
  EXPECT_NEAR(*one.held_stress_pa / one.turn_stress_pa, *all.held_stress_pa / all.turn_stress_pa, 1e-4);
  EXPECT_NEAR(*one.dwelled_strain, *all.dwelled_strain, 2e-5);
}

TEST(PausedPull, TwoBranchesRelaxWithTheirTimes) {
  constexpr double kFirst = 0.8, kTau = 0.05, kSecond = 0.5, kTimes = 200.0, kStrain = 1e-4, kRampS = kStrain / 1e-2;
  const PausedPull one = paused({{"rate_prony", {kFirst, kTau, kSecond, kTimes}}}, {{kStrain}, {0.1}});
  const auto loaded = [](double share, double tau_s) { return share * tau_s / kRampS * -std::expm1(-kRampS / tau_s); };
  const double first = loaded(kFirst, kTau), second = loaded(kSecond, kTimes * kTau);
  const double left = 1.0 + first * std::exp(-0.1 / kTau) + second * std::exp(-0.1 / (kTimes * kTau));
  EXPECT_NEAR(*one.held_stress_pa / one.turn_stress_pa, left / (1.0 + first + second), 1e-6);
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
