// Time saved by a static start, and its cost in accuracy: specimens are pulled from rest, and again from static
// equilibrium at a share of the strain at which their first element failed. Results: docs/studies/speed.md.

#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cpu_time.hpp"
#include "fem/static_solver.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_record.hpp"
#include "tester/fracture_test.hpp"

namespace {

using namespace nacre;
using namespace nacre::bench;

struct StartedPull {
  double toughness_pa = 0.0, first_failure_strain = 0.0, end_strain = 0.0, seconds = 0.0;
};

/// From `start` (in which the solver already is, under `start_stress_pa`) to a stress below 20 % of the peak. Peaks and
/// separation on means over 400 steps.
StartedPull pull(fem::ExplicitSolver<float>& solver, const tester::FractureTest& test, double start_stress_pa) {
  StartedPull result;
  const double start = solver.strain();
  const int transit = 400;
  tester::FractureRecord record({.strain_per_step = test.settings.strain_rate_per_s * test.settings.time_step_s,
                                 .steps_per_sample = test.steps_per_sample,
                                 .transit_steps = transit,
                                 .strain_limit = test.strain_limit});
  if (start > 0.0) record.add(start, start_stress_pa);
  result.seconds = seconds_of([&] {
    while (solver.strain() < test.strain_limit) {
      const fem::StepReport report = solver.step().value();
      if (report.failed > 0 && result.first_failure_strain == 0.0) result.first_failure_strain = report.strain;
      record.add(report.strain, report.stress_pa());
      if (record.separated()) break;
    }
  });
  result.toughness_pa = record.toughness_pa();
  result.end_strain = solver.strain();
  return result;
}

/// The solver in static equilibrium at its initial strain, moving with the grips' linear profile.
double start_statically(fem::ExplicitSolver<float>& solver, const tester::FractureTest& test, double strain) {
  const fem::StaticSolution state = fem::pull(test.grid, strain).value();
  const double h = test.grid.element_size_m;
  for (int node = 0; node < (test.grid.columns + 1) * (test.grid.rows + 1); ++node) {
    const auto at = static_cast<std::size_t>(2 * node);
    const double height = node / (test.grid.columns + 1);
    solver.set_node(node, h * Eigen::Vector2d(state.displacement[at], state.displacement[at + 1]),
                    Eigen::Vector2d(0.0, test.settings.strain_rate_per_s * height * h));
  }
  return state.top_stress_pa;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A static start below the first failure: time saved, toughness changed"};
  int count = 8;
  std::string fidelity = "full";
  double share = 0.9;
  app.add_option("--count", count, "random patterns");
  app.add_option("--fidelity", fidelity, "fidelity");
  app.add_option("--share", share, "of the strain at the first failure");
  CLI11_PARSE(app, argc, argv);
  RandomStream random(2, "static start");
  fmt::print(
      "| pattern | first failure at strain | end | T, MPa | from rest, s | static solution, s | from there, s | T "
      "changed |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(count, random)) {
    tester::FractureTest test = tester::fracture_test({.design = pattern,
                                                       .parameters = material::default_parameters(),
                                                       .conditions = {},
                                                       .fidelity = tester::fidelity_from_string(fidelity).value()});
    auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
    const StartedPull rest = pull(solver, test, 0.0);
    test.settings.initial_strain = share * rest.first_failure_strain;
    auto later = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
    double stress_pa = 0.0;
    const double solution =
        seconds_of([&] { stress_pa = start_statically(later, test, test.settings.initial_strain); });
    const StartedPull from_there = pull(later, test, stress_pa);
    fmt::print("| {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {:.2f} | {:.2f} | {:+.1f} % |\n", pattern.key(),
               rest.first_failure_strain, rest.end_strain, rest.toughness_pa * 1e-6, rest.seconds, solution,
               from_there.seconds, 100.0 * (from_there.toughness_pa / rest.toughness_pa - 1.0));
    std::fflush(stdout);
  }
}
