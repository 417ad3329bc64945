// Time of one modulus on one thread, and of its parts.

#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "fem/element.hpp"
#include "fem/frontal_cholesky.hpp"
#include "fem/static_solver.hpp"
#include "tester/assembly.hpp"
#include "tester/modulus.hpp"

namespace nacre {
namespace {

tester::Simulation published(tester::Fidelity fidelity) {
  return {.design = pattern::design_from_name("3ffc9b4ad4d2d9").value(),
          .parameters = material::default_parameters(),
          .conditions = {},
          .fidelity = fidelity};
}

void modulus(benchmark::State& state, tester::Fidelity fidelity) {
  const tester::Simulation simulation = published(fidelity);
  const tester::Discretisation discretisation{.refinement = static_cast<int>(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(tester::test_modulus(simulation, discretisation));
}
BENCHMARK_CAPTURE(modulus, full, tester::Fidelity::full)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(modulus, tiny, tester::Fidelity::tiny)->Arg(1)->Unit(benchmark::kMillisecond);

void assembly(benchmark::State& state) {
  const tester::Simulation simulation = published(tester::Fidelity::full);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        tester::assemble(simulation.design, simulation.parameters, {}, tester::AssemblyTarget::modulus, 2, 1));
}
BENCHMARK(assembly)->Unit(benchmark::kMillisecond);

/// The factorisation of the full specimen by itself, held as in the tester.
struct Factorisation {
  Factorisation() {
    const tester::Simulation simulation = published(tester::Fidelity::full);
    const fem::Grid grid =
        tester::assemble(simulation.design, simulation.parameters, {}, tester::AssemblyTarget::modulus, 2, 1);
    held.assign(static_cast<std::size_t>(2 * (grid.columns + 1) * (grid.rows + 1)), 0);
    for (int column = 0; column <= grid.columns; ++column)
      held[2 * column + 1] = held[2 * (grid.rows * (grid.columns + 1) + column) + 1] = 1;
    held[0] = 1;
    lame = fem::lame_of(grid);
    cholesky =
        std::make_unique<fem::FrontalCholesky>(std::make_shared<const fem::DissectionPlan>(fem::dissect(grid, held)));
    cholesky->factorise(lame);
  }
  std::vector<char> held;
  std::vector<material::Lame> lame;
  std::unique_ptr<fem::FrontalCholesky> cholesky;
};

void factorise(benchmark::State& state) {
  Factorisation factorisation;
  for (auto _ : state) benchmark::DoNotOptimize(factorisation.cholesky->factorise(factorisation.lame));
}
BENCHMARK(factorise)->Unit(benchmark::kMicrosecond);

void solve(benchmark::State& state) {
  Factorisation factorisation;
  std::vector<double> x(factorisation.held.size(), 1.0);
  for (auto _ : state) {
    factorisation.cholesky->solve(x);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(solve)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace nacre

BENCHMARK_MAIN();
