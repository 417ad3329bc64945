// Time of one modulus on one thread, and of its parts.

#include <benchmark/benchmark.h>

#include "fem/static_solver.hpp"
#include "tester/assembly.hpp"
#include "tester/tester.hpp"

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
  const tester::Numerics numerics{.refinement = static_cast<int>(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(tester::test_modulus(simulation, numerics));
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

}  // namespace
}  // namespace nacre

BENCHMARK_MAIN();
