// What the thesis' modulus tester is off by when it stops after 10^4 steps, over the range of gamma: explicit over
// static modulus on random patterns. Results: docs/studies/speed.md.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/parallel.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/modulus.hpp"
#include "tester/modulus_explicit.hpp"

namespace {

using namespace nacre;

/// E after `steps` steps over the static E, minus 1, for each grid.
std::vector<double> biases(const std::vector<fem::Grid>& grids, const std::vector<double>& exact, double gamma_per_s,
                           int steps) {
  std::vector<double> result(grids.size());
  parallel_for(static_cast<int>(grids.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    result[at] = tester::explicit_modulus(grids[at], gamma_per_s, steps).value() / exact[at] - 1.0;
  });
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Bias of the explicit modulus that stops after a number of steps"};
  int count = 8, steps = thesis::kModulusSteps;
  std::vector<double> gammas = {2e4, 5e4, 1e5, 2e5, 3e5, 5e5, 1e6, 2e6};
  app.add_option("--count", count, "random patterns");
  app.add_option("--steps", steps, "time steps");
  app.add_option("--gammas", gammas, "damping, 1/s");
  CLI11_PARSE(app, argc, argv);
  RandomStream random(1, "explicit bias");
  std::vector<fem::Grid> grids;
  std::vector<double> exact;
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(count, random)) {
    const tester::Simulation simulation{
        .design = pattern, .parameters = material::default_parameters(), .conditions = {}};
    const tester::SpecimenUnits units = tester::modulus_units(simulation.fidelity);
    grids.push_back(
        tester::assemble(pattern, simulation.parameters, {}, tester::AssemblyTarget::modulus, units.x, units.y));
    exact.push_back(tester::test_modulus(simulation).value().modulus_pa);
  }
  fmt::print("| gamma, 1/s | lowest | median | highest |\n| --- | --- | --- | --- |\n");
  for (const double gamma : gammas) {
    const std::vector<double> bias = biases(grids, exact, gamma, steps);
    fmt::print("| {:g} | {:+.2e} | {:+.2e} | {:+.2e} |\n", gamma, bias.front(), bias[bias.size() / 2], bias.back());
  }
}
