// Speed of the explicit kernel: element-steps per second on one thread for every instruction set this machine has, and
// seconds per specimen for the fidelities. All elements of the grid are counted, empty ones too.

#include <cstdio>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/processor_time.hpp"
#include "material/parameter_file.hpp"
#include "tester/fracture_test.hpp"

namespace {

using namespace nacre;

double seconds_of(const std::function<void()>& work) {
  const double start = processor_time_s();
  work();
  return processor_time_s() - start;
}

/// Best of `repeats` runs of `steps` steps after the same number of warm-up steps.
template <class Real>
double element_steps_per_s(const tester::FractureTest& test, fem::SimdLevel level, int steps, int repeats) {
  fem::ExplicitSettings settings = test.settings;
  settings.simd = level;
  auto solver = fem::ExplicitSolver<Real>::create(test.grid, settings);
  double best = 1e300;
  for (int repeat = 0; repeat <= repeats; ++repeat)
    best = std::min(best, seconds_of([&] {
                      for (int i = 0; i < steps; ++i) (void)solver->step();
                    }));
  return steps * static_cast<double>(test.grid.element_count()) / best;
}

void print_levels(const tester::Simulation& simulation) {
  const tester::FractureTest test = tester::fracture_test(simulation);
  for (const fem::SimdLevel level : {fem::SimdLevel::baseline, fem::SimdLevel::avx2, fem::SimdLevel::avx512}) {
    if (!fem::has_simd_level(level)) continue;
    const int steps = level == fem::SimdLevel::baseline ? 5 : 200;
    fmt::print("{:9} {:13} {:9} {:.3g} element-steps/s single, {:.3g} double\n", tester::to_string(simulation.fidelity),
               material::to_string(simulation.parameters.criterion.kind), fem::to_string(level),
               element_steps_per_s<float>(test, level, steps, 5),
               element_steps_per_s<double>(test, level, steps / 5, 3));
  }
}

void print_specimen(tester::Simulation simulation, const std::string& name) {
  Result<tester::ToughnessResult> result = fail("not run");
  const double seconds = seconds_of([&] { result = tester::test_toughness(simulation); });
  if (!result) {
    fmt::print("{:28} {:8} {}\n", name, tester::to_string(simulation.fidelity), result.error().message);
    return;
  }
  fmt::print("{:28} {:8} {:7.3f} s {:6} steps {:.3g} el-steps/s  T {:8.5f} MPa  peak {:8.4f} MPa  strain {:.5f}  {}\n",
             name, tester::to_string(simulation.fidelity), seconds, result->steps,
             result->steps * result->element_count / seconds, result->toughness_pa * 1e-6,
             result->peak_stress_pa * 1e-6, result->failure_strain, tester::to_string(result->end));
}

void pull_designs(tester::Simulation simulation, const std::vector<std::string>& designs) {
  for (const std::string& design : designs) {
    simulation.design = pattern::design_from_argument(design);
    print_specimen(simulation, fmt::format("{} {}", material::to_string(simulation.parameters.criterion.kind), design));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Speed of the explicit kernel"};
  std::vector<std::string> designs;
  std::vector<std::string> fidelities = {"tiny", "preview", "full"};
  std::string parameters;
  std::vector<std::string> criteria = {"element"};
  bool levels = false;
  app.add_option("designs", designs, "designs to pull to separation: keys, files, soft, rigid, mix:F");
  app.add_option("--fidelity", fidelities, "fidelities");
  app.add_option("--criterion", criteria, "element, neighbourhood, crack_band");
  app.add_option("--params", parameters, "parameter file");
  app.add_flag("--levels", levels, "compare the instruction sets");
  CLI11_PARSE(app, argc, argv);
  tester::Simulation simulation{
      .design = pattern::Mixture{1.0}, .parameters = material::default_parameters(), .conditions = {}};
  if (!parameters.empty()) simulation.parameters = material::read_parameters(parameters, simulation.parameters);
  for (const std::string& fidelity : fidelities) {
    simulation.fidelity = tester::fidelity_from_string(fidelity).value();
    for (const std::string& criterion : criteria) {
      simulation.parameters.criterion.kind = material::criterion_from_string(criterion).value();
      if (levels) print_levels(simulation);
      pull_designs(simulation, designs);
    }
  }
}
