// How fast kernel and testers are, against what the core can do, plain scalar references and the thesis' V100, all
// measured in one run. Results: docs/studies/speed.md. Times are processor time of the thread unless it says wall.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/parallel.hpp"
#include "cpu_time.hpp"
#include "fem/explicit_storage.hpp"
#include "fem/static_solver.hpp"
#include "machine_limits.hpp"
#include "pattern/random_pattern.hpp"
#include "scalar_explicit.hpp"
#include "sparse_modulus.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/fracture_test.hpp"
#include "tester/modulus.hpp"

namespace {

using namespace nacre;
using namespace nacre::bench;

/// The thesis' V100 (Figure 3-5): 25,000 steps of 32,000 elements in 0.5 s, 10,000 steps of 3,200 in 0.015 s.
constexpr double kV100ToughnessRate = 25'000.0 * 32'000.0 / 0.5, kV100ModulusSeconds = 0.015;

/// Arithmetic of the explicit kernel per element and step, node included, as its source has it (failure check and
/// filter, no element beyond |J - 1| = 0.29). Comparisons and shifts of vectors are not counted.
constexpr double kMultiplications = 56, kFused = 72, kAdditions = 84, kDivisions = 4;
constexpr double kOperations = kMultiplications + 2 * kFused + kAdditions + kDivisions;
/// Bytes per element and step that come from beyond L1: displacements and velocities read and written, three constants.
constexpr double kBytes = 4.0 * (4 + 4 + 3);

tester::Simulation published(tester::Fidelity fidelity) {
  return {.design = pattern::design_from_name("577fffe9fffdef").value(),
          .parameters = material::default_parameters(),
          .conditions = {},
          .fidelity = fidelity};
}

/// Seconds per step, the least of some runs of `steps` steps from rest on.
template <class Solver>
double step_seconds(Solver& solver, int steps, int repeats) {
  return least_seconds_of(repeats,
                          [&] {
                            for (int i = 0; i < steps; ++i) (void)solver.step();
                          }) /
         steps;
}

template <class Real>
double kernel_rate(const tester::FractureTest& test, fem::SimdLevel level) {
  fem::ExplicitSettings settings = test.settings;
  settings.simd = level;
  auto solver = fem::ExplicitSolver<Real>::create(test.grid, settings).value();
  const int steps = level == fem::SimdLevel::baseline ? 4 : sizeof(Real) == 4 ? 200 : 80;
  return test.grid.element_count() / step_seconds(solver, steps, 7);
}

/// Stress of the two after some hundred steps, as a ratio: they compute the same.
double agreement(const tester::FractureTest& test) {
  auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
  ScalarExplicit reference(test.grid, test.settings);
  double ours = 0.0, theirs = 0.0;
  for (int step = 0; step < 400; ++step) {
    ours = solver.step().value().stress_pa();
    theirs = reference.step();
  }
  return ours / theirs;
}

void print_limits(const MachineLimits& limits, fem::SimdLevel level) {
  fmt::print("## The core\n{}; {}, {:.2f} GHz measured, single precision, one thread.\n\n", core_name(),
             fem::to_string(level), limits.clock_hz * 1e-9);
  fmt::print("| limit | measured |\n| --- | --- |\n");
  fmt::print("| fused multiply-adds alone | {:.1f} Gflop/s |\n", limits.fused_per_s * 1e-9);
  fmt::print("| multiplications and additions, as many | {:.1f} Gflop/s |\n", limits.multiply_and_add_per_s * 1e-9);
  fmt::print("| divisions | {:.1f} G/s |\n", limits.divisions_per_s * 1e-9);
  for (const Bandwidth& memory : limits.memory)
    fmt::print("| {} ({} kB) | read {:.0f} GB/s, read and written in place {:.0f} GB/s |\n", memory.level,
               memory.bytes >> 10, memory.read_per_s * 1e-9, memory.update_per_s * 1e-9);
}

void print_fractions(const MachineLimits& limits, double rate, fem::SimdLevel level, const fem::Grid& grid) {
  const double lanes = level == fem::SimdLevel::avx512 ? 16 : 8;
  const double vectors = (grid.columns / 16 + 1) * 16.0 / grid.columns;  // padded rows
  const double multiplier = rate * (kMultiplications + kFused) * vectors / (limits.fused_per_s / 2);
  const double divider = rate * kDivisions * vectors / limits.divisions_per_s;
  const double cycles = limits.clock_hz / (rate * vectors) * lanes;
  fmt::print("\n## What bounds the kernel\n");
  fmt::print(
      "{} arithmetic operations per element-step ({} multiplications, {} fused, {} additions, {} divisions): "
      "{:.0f} Gflop/s, {:.0f} % of the fused peak; {:.0f} cycles per vector of {} elements. The multipliers are "
      "busy {:.0f} % of the time (empty elements that pad a row included), the divider {:.0f} %.\n",
      kOperations, kMultiplications, kFused, kAdditions, kDivisions, rate * kOperations * 1e-9,
      100 * rate * kOperations / limits.fused_per_s, cycles, lanes, 100 * multiplier, 100 * divider);
  const double bytes_per_s = rate * kBytes;
  fmt::print("{} bytes per element-step from beyond L1: {:.1f} GB/s,", kBytes, bytes_per_s * 1e-9);
  for (std::size_t i = 1; i < limits.memory.size(); ++i)
    fmt::print(" {:.0f} % of {}{}", 100 * bytes_per_s / limits.memory[i].update_per_s, limits.memory[i].level,
               i + 1 < limits.memory.size() ? "," : ".\n");
}

void print_kernel(const MachineLimits& limits, fem::SimdLevel level) {
  const tester::FractureTest test = tester::fracture_test(published(tester::Fidelity::full));
  ScalarExplicit reference(test.grid, test.settings);
  const double scalar = test.grid.element_count() / step_seconds(reference, 10, 5);
  fmt::print("\n## Kernel, full specimen ({} x {} elements), element-steps/s of one core\n", test.grid.columns,
             test.grid.rows);
  fmt::print("| | single | over scalar | over V100 ({:.1e}) | double |\n| --- | --- | --- | --- | --- |\n",
             kV100ToughnessRate);
  fmt::print("| plain scalar C++ | {:.3g} | 1 | {:.4f} | |\n", scalar, scalar / kV100ToughnessRate);
  double best = 0.0;
  for (const fem::SimdLevel each : {fem::SimdLevel::baseline, fem::SimdLevel::avx2, fem::SimdLevel::avx512}) {
    if (!fem::has_simd_level(each)) continue;
    const double rate = kernel_rate<float>(test, each);
    if (each == level) best = rate;
    fmt::print("| {} | {:.3g} | {:.1f} | {:.3f} | {:.3g} |\n", fem::to_string(each), rate, rate / scalar,
               rate / kV100ToughnessRate, kernel_rate<double>(test, each));
  }
  fmt::print("\nStress of kernel over that of the reference after 400 steps: {:.6f}.\n", agreement(test));
  for (const tester::Fidelity fidelity : {tester::Fidelity::tiny, tester::Fidelity::preview}) {
    const tester::FractureTest small = tester::fracture_test(published(fidelity));
    const double vectors = (small.grid.columns / 16 + 1) * 16.0 / small.grid.columns;
    const double rate = kernel_rate<float>(small, level);
    fmt::print("{} ({} x {}): {:.3g}, {:.3g} with the padding of rows counted.\n", tester::to_string(fidelity),
               small.grid.columns, small.grid.rows, rate, rate * vectors);
  }
  print_fractions(limits, best, level, test.grid);
}

/// Mean seconds per sample of work(i) for i in [0, count), on `threads` threads at once.
struct Throughput {
  double cpu_seconds = 0.0;   ///< processor time per sample
  double wall_seconds = 0.0;  ///< wall time per sample
};

template <class Work>
Throughput throughput(int count, int threads, const Work& work) {
  std::vector<double> seconds(count);
  const auto start = std::chrono::steady_clock::now();
  parallel_for(
      count, [&](int i) { seconds[i] = seconds_of([&] { work(i); }); }, threads);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  double sum = 0.0;
  for (const double each : seconds) sum += each;
  return {.cpu_seconds = sum / count, .wall_seconds = wall.count() / count};
}

void print_row(const std::string& name, const Throughput& one, const Throughput& all, int threads) {
  fmt::print("| {} | {:.4g} | {:.4g} | {:.2f} | {:.2f} |\n", name, one.cpu_seconds, all.cpu_seconds,
             threads * one.cpu_seconds / all.cpu_seconds, one.wall_seconds / all.wall_seconds);
}

void print_testers(int count) {
  RandomStream random(1, "speed");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(count, random);
  const auto simulation = [&](int i) {
    tester::Simulation s = published(tester::Fidelity::full);
    s.design = patterns[i % count];
    return s;
  };
  const int threads = allowed_cores(), moduli = 200;
  const auto modulus = [&](int i) { (void)tester::test_modulus(simulation(i)).value(); };
  std::vector<std::int64_t> steps(patterns.size());
  const auto toughness = [&](int i) { steps[i] = tester::test_toughness(simulation(i)).value().steps; };
  const auto both = [&](int i) {
    modulus(i);
    toughness(i);
  };
  fmt::print("\n## Testers and samples end to end, full specimens, {} random patterns\n", count);
  fmt::print("Processor seconds per sample; {} threads against one, by processor time and by wall time.\n\n", threads);
  fmt::print("| | alone | {} threads | speed-up (processor) | speed-up (wall) |\n| --- | --- | --- | --- | --- |\n",
             threads);
  modulus(0);
  const Throughput one_modulus = throughput(moduli, 1, modulus), all_modulus = throughput(moduli, threads, modulus);
  print_row("modulus", one_modulus, all_modulus, threads);
  const Throughput one = throughput(count, 1, both), all = throughput(count, threads, both);
  print_row("modulus and toughness", one, all, threads);
  double mean_steps = 0.0;
  for (const std::int64_t each : steps) mean_steps += static_cast<double>(each) / count;

  const fem::Grid grid =
      tester::assemble(simulation(0).design, simulation(0).parameters, {}, tester::AssemblyTarget::modulus, 2, 1);
  double reference = 0.0;
  const double sparse = least_seconds_of(5, [&] { reference = sparse_modulus_pa(grid); });
  const double ours = tester::test_modulus(simulation(0)).value().modulus_pa;
  fmt::print(
      "\nModulus: {:.2f} ms; Eigen's sparse Cholesky {:.1f} ms ({:.1f} times, E differs by {:.1e}); the V100 "
      "{:.0f} ms ({:.1f} times).\n",
      1e3 * one_modulus.cpu_seconds, 1e3 * sparse, sparse / one_modulus.cpu_seconds, ours / reference - 1.0,
      1e3 * kV100ModulusSeconds, kV100ModulusSeconds / one_modulus.cpu_seconds);
  const double toughness_seconds = one.cpu_seconds - one_modulus.cpu_seconds;
  fmt::print(
      "Toughness: {:.2f} s for {:.0f} steps on average, {:.3g} element-steps/s with recording; end to end "
      "{:.2f} samples/s per core.\n",
      toughness_seconds, mean_steps, 32'000 * mean_steps / toughness_seconds, 1.0 / one.cpu_seconds);
}

void print_memory() {
  fmt::print("\n## Memory of one specimen\n| fidelity | explicit state, MB | grid, MB |\n| --- | --- | --- |\n");
  for (const tester::Fidelity fidelity : {tester::Fidelity::tiny, tester::Fidelity::preview, tester::Fidelity::full}) {
    const tester::SpecimenUnits units = tester::toughness_units(fidelity);
    const int columns = units.x * tester::kElementsPerUnit, rows = units.y * tester::kElementsPerUnit;
    const fem::ExplicitStorage<float> storage(columns, rows, false);
    const double grid_bytes = columns * rows * (3.0 * sizeof(double) + sizeof(fem::Phase));
    fmt::print("| {} | {:.2f} | {:.2f} |\n", tester::to_string(fidelity), 1e-6 * static_cast<double>(storage.bytes()),
               1e-6 * grid_bytes);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Speed of kernel and testers against the core, scalar references and the V100"};
  int count = 8;
  bool kernel_only = false;
  app.add_option("--count", count, "patterns for the testers");
  app.add_flag("--kernel-only", kernel_only, "limits and kernel only");
  CLI11_PARSE(app, argc, argv);
  const fem::SimdLevel level = fem::best_simd_level();
  if (level == fem::SimdLevel::baseline) {
    fmt::print(stderr, "this processor has no AVX2: nothing to compare\n");
    return 1;
  }
  const MachineLimits limits = measure_limits(level);
  print_limits(limits, level);
  print_kernel(limits, level);
  print_memory();
  if (!kernel_only) print_testers(count);
}
