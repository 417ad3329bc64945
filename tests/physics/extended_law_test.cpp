// The extended kernel against the point law (material/extended_law.hpp), against the base kernel, and against itself on
// other instruction sets.

#include <cmath>

#include <gtest/gtest.h>

#include "../grids.hpp"
#include "fem/static_solver.hpp"
#include "material/pulled_bar.hpp"
#include "specimens.hpp"

namespace nacre {
namespace {

using verification::patterns;
using verification::specimen;

constexpr double kYoungPa = 1e9, kPoisson = 0.3, kThreshold = 2e6, kRate = 20.0;

/// A strip of one material without notch.
fem::Grid strip(double young_pa = kYoungPa) { return fem::uniform_grid(12, 8, {young_pa, kPoisson, kThreshold}); }

fem::ExplicitSettings settings_for(const fem::Grid& grid) {
  const double dt = 0.5 * grid.element_size_m / fem::fastest_wave_m_per_s(grid, 1150.0);
  return {.density_kg_per_m3 = 1150.0,
          .time_step_s = dt,
          .strain_rate_per_s = kRate,
          .damping = fem::Damping::smoothing,
          .gamma_per_s = 0.3 / dt,
          .simd = {}};
}

/// Pulls a strip and a point with the same law to `end`; the largest difference of stress over the largest stress,
/// means over windows so that the ringing of the start does not count.
double largest_difference(const fem::Grid& grid, const material::ExtendedLaw& law, double end) {
  const fem::ExplicitSettings settings = settings_for(grid);
  auto solver = fem::ExplicitSolver<float>::create(grid, settings).value();
  material::PulledBar point(law);
  const int window = static_cast<int>(1e-3 / (kRate * settings.time_step_s));
  double worst = 0.0, largest = 0.0;
  while (solver.strain() < end) {
    double mean_pa = 0.0;
    const double middle = solver.strain() + 0.5e-3;
    for (int i = 0; i < window; ++i) mean_pa += solver.step().value().stress_pa() / window;
    const double exact_pa = point.pull(middle, window * settings.time_step_s);
    largest = std::max(largest, std::abs(exact_pa));
    if (middle > 0.01) worst = std::max(worst, std::abs(mean_pa - exact_pa));
  }
  return worst / largest;
}

material::ExtendedLaw law_of(const material::Lame& lame) { return {.lame = lame, .threshold_j_per_m3 = kThreshold}; }

struct LawCase {
  const char* name;
  fem::Grid grid;
  material::ExtendedLaw law;
  double end;
};

std::vector<LawCase> cases() {
  const material::Lame lame = material::lame_from_engineering(kYoungPa, kPoisson);
  const auto everywhere = [](double value) { return std::vector<double>(strip().phase.size(), value); };
  std::vector<LawCase> all;
  const auto add = [&](const char* name, double end) -> LawCase& {
    all.push_back({name, strip(), law_of(lame), end});
    return all.back();
  };
  LawCase& gent = add("Gent", 0.055);
  gent.grid.laws.inverse_limit = everywhere(gent.law.inverse_limit = 20.0);
  LawCase& flow = add("flow", 0.06);
  flow.grid.laws.yield_pa = everywhere(flow.law.yield_pa = 2.5e7);
  LawCase& branch = add("branch", 0.04);
  branch.grid.laws.overstress = branch.law.overstress = 0.6;
  branch.grid.laws.relaxation_time_s = branch.law.relaxation_time_s = 8e-4;
  LawCase& all_of_them = add("all", 0.05);
  all_of_them.grid.laws = {.eigenstrain = {},
                           .inverse_limit = everywhere(all_of_them.law.inverse_limit = 5.0),
                           .yield_pa = everywhere(all_of_them.law.yield_pa = 2.5e7),
                           .overstress = all_of_them.law.overstress = 0.3,
                           .relaxation_time_s = all_of_them.law.relaxation_time_s = 8e-4,
                           .tension_only = all_of_them.law.tension_only = 0.5};
  return all;
}

TEST(ExtendedKernel, StripsFollowThePointLaw) {
  for (const LawCase& each : cases()) EXPECT_LT(largest_difference(each.grid, each.law, each.end), 0.02) << each.name;
}

// One row softens between rows too stiff to store energy: the work of the grips is the declared energy of that row.
TEST(ExtendedKernel, SofteningRowSpendsTheDeclaredEnergy) {
  for (const double softening : {0.5, 2.0}) {
    fem::Grid grid = strip(100.0 * kYoungPa);
    std::fill(grid.poisson.begin(), grid.poisson.end(), 0.0);
    std::fill(grid.threshold_j_per_m3.begin(), grid.threshold_j_per_m3.end(), 1e3 * kThreshold);
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(4, column));
      grid.young_pa[e] = kYoungPa;
      grid.threshold_j_per_m3[e] = 0.1 * kThreshold;
    }
    grid.laws.softening = softening;
    fem::ExplicitSettings settings = settings_for(grid);
    auto solver = fem::ExplicitSolver<float>::create(grid, settings).value();
    double work = 0.0;
    int failed = 0;
    while (failed < grid.columns && solver.strain() < 0.1) {
      const fem::StepReport report = solver.step().value();
      work += report.stress_pa() * settings.strain_rate_per_s * settings.time_step_s;
      failed += report.failed;
    }
    EXPECT_EQ(failed, grid.columns);
    EXPECT_NEAR(work / (0.1 * kThreshold * (1.0 + softening) / grid.rows), 1.0, 0.05) << softening;
  }
}

// The sweep of the extended kernel with the base law in it, through a whole crack.
TEST(ExtendedKernel, WithNegligibleLawsBreaksAsTheBaseKernel) {
  tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  const tester::ToughnessResult base = tester::run_fracture_test<float>(test).value();
  test.grid.laws.overstress = 1e-20;
  test.grid.laws.relaxation_time_s = 1.0;
  const tester::ToughnessResult extended = tester::run_fracture_test<float>(test).value();
  EXPECT_NEAR(extended.peak_stress_pa / base.peak_stress_pa, 1.0, 1e-3);
  EXPECT_NEAR(extended.toughness_pa / base.toughness_pa, 1.0, 0.05) << "rounding differs, and cracks feel it";
  EXPECT_EQ(extended.breaks.front().element, base.breaks.front().element);
}

tester::Simulation with_all_laws() {
  tester::Simulation simulation = specimen(patterns(2)[1]);
  simulation.parameters.extensions = {{"rigid_yield", {2e7}},           {"soft_stiffening", {1.0}},
                                      {"rate_dependence", {0.4, 10.0}}, {"progressive_damage", {0.5}},
                                      {"tension_only_failure", {0.7}},  {"residual_strain", {0.004}}};
  return simulation;
}

TEST(ExtendedKernel, SameBitsFromEveryInstructionSet) {
  tester::FractureTest test = tester::fracture_test(with_all_laws());
  test.grid.laws.eigenstrain.clear();  // the static rest has tests of its own
  test.settings.strain_rate_per_s *= 4.0;
  const auto results = verification::pulled_by_every_simd_level(test, 3000);
  for (const auto& pulled : results) {
    EXPECT_GT(pulled.failed, 10);
    EXPECT_EQ(pulled.stresses_pa, results.front().stresses_pa) << fem::to_string(pulled.level);
  }
}

TEST(ExtendedKernel, AllLawsAtOnceBreakASpecimenAndDoSoTwiceAlike) {
  const Result<tester::ToughnessResult> first = tester::test_toughness(with_all_laws()),
                                        second = tester::test_toughness(with_all_laws());
  ASSERT_TRUE(first.has_value()) << first.error().message;
  EXPECT_EQ(first->end, tester::EndReason::stress_drop);
  EXPECT_EQ(first->curve, second->curve);
  EXPECT_EQ(first->toughness_pa, second->toughness_pa);
}

TEST(ResidualStrain, OfOneMaterialMovesTheGripsAndStressesNothing) {
  fem::Grid grid = strip();
  grid.laws.eigenstrain.assign(grid.phase.size(), -0.015);
  const fem::RestingSolution rest = fem::pull_from_rest(grid, 1e-4).value();
  EXPECT_NEAR(rest.rest_strain, -0.015, 1e-8);
  // Per width as printed: the strip has shrunk, its material has not changed.
  EXPECT_NEAR(rest.stress_pa / 1e-4 / (kYoungPa * (1.0 - 0.015)), 1.0, 5e-4);
  EXPECT_NEAR(rest.displacement[2] - rest.displacement[0], -0.015, 1e-8) << "sideways too";
}

// Columns of two stiffnesses stretch alike; without sideways coupling they rest where their forces cancel.
TEST(ResidualStrain, OfColumnsRestsAtTheStiffnessWeightedMean) {
  fem::Grid grid = strip();
  grid.laws.eigenstrain.assign(grid.phase.size(), 0.0);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      grid.poisson[e] = 0.0;
      if (column >= 6) continue;
      grid.young_pa[e] = 3e9;
      grid.laws.eigenstrain[e] = -0.004;
    }
  EXPECT_NEAR(fem::pull_from_rest(grid, 0.0).value().rest_strain, -0.003, 3e-5);
}

// A mounted specimen has relaxed: only later strain is stiffer by the branch.
TEST(ResidualStrain, LeavesNoOverstressWhereASpecimenRests) {
  fem::Grid grid = strip();
  fem::ExplicitSettings settings = settings_for(grid);
  settings.initial_strain = 0.01;
  const double elastic_pa = fem::ExplicitSolver<float>::create(grid, settings).value().step().value().top_stress_pa;
  grid.laws.overstress = 1.0;
  grid.laws.relaxation_time_s = 1.0;  // long compared with the test
  grid.laws.softening = 1.0;
  settings = settings_for(grid);
  settings.initial_strain = 0.01;
  auto at_once = fem::ExplicitSolver<float>::create(grid, settings).value(),
       rested = fem::ExplicitSolver<float>::create(grid, settings).value();
  rested.relax();
  EXPECT_NEAR(at_once.step()->top_stress_pa / elastic_pa, 2.0, 0.01);
  EXPECT_NEAR(rested.step()->top_stress_pa / elastic_pa, 1.0, 0.01);
  double begun = 0.0, ended = 0.0;  // from 1 to 2 % strain, the means of two windows
  for (; rested.strain() < 0.011;) begun = 0.9 * begun + 0.1 * rested.step()->stress_pa();
  for (; rested.strain() < 0.02;) ended = 0.9 * ended + 0.1 * rested.step()->stress_pa();
  EXPECT_NEAR((ended - begun) / 0.009 / (elastic_pa / 0.01), 2.0, 0.25);
}

// A mounted specimen at rest carries no force until it is pulled.
TEST(ResidualStrain, AMountedSpecimenStartsWithoutForce) {
  tester::Simulation simulation = specimen(patterns(2)[1]);
  simulation.parameters.extensions = {{"residual_strain", {0.01}}};
  const tester::ToughnessResult result = tester::test_toughness(simulation).value();
  EXPECT_LT(std::abs(result.curve.stress_pa[1]), 0.05 * result.peak_stress_pa);
  EXPECT_GE(result.curve.strain[1], 0.0);
  EXPECT_LT(result.curve.strain[1], 3e-4);
}

}  // namespace
}  // namespace nacre
