// How well a smaller or coarser-stepped toughness specimen stands in for the full one: T and seconds per specimen on
// random patterns, then Spearman's rank correlation with full and the mean ratio, for candidates given as
// UNITSxUNITSxSTEP (STEP scales the time step; it is held at the stability limit).

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/fracture_test.hpp"
#include "tester/notch.hpp"

namespace {

using namespace nacre;

struct Candidate {
  int units_x = 5, units_y = 4;
  double step_scale = 1.0;
};

struct Outcome {
  double toughness_pa = 0.0;
  double seconds = 0.0;
};

/// Time of this thread on a processor, so that other work on the machine does not count.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Outcome pull(const tester::Simulation& simulation, const Candidate& candidate) {
  tester::FractureTest test = tester::fracture_test(simulation);
  test.grid = tester::assemble(simulation.design, simulation.parameters, simulation.conditions,
                               tester::AssemblyTarget::toughness, candidate.units_x, candidate.units_y);
  tester::cut_notch(test.grid, 1);
  const double limit = std::min(0.8 * test.grid.element_size_m / fem::fastest_wave_m_per_s(test.grid, 1150.0),
                                0.8 / test.settings.gamma_per_s);
  test.settings.time_step_s = std::min(test.settings.time_step_s * candidate.step_scale, limit);
  const double start = cpu_seconds();
  const auto result = tester::run_fracture_test<float>(test);
  const double seconds = cpu_seconds() - start;
  return {result ? result->toughness_pa : std::nan(""), seconds};
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<double>(i);
  return rank;
}

double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ra = ranks(a), rb = ranks(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < ra.size(); ++i) sum += (ra[i] - rb[i]) * (ra[i] - rb[i]);
  const double n = static_cast<double>(ra.size());
  return 1.0 - 6.0 * sum / (n * (n * n - 1.0));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Fidelity of smaller toughness specimens"};
  int count = 12;
  std::vector<std::string> names = {"3x2x1", "3x2x4", "2x2x4", "1x1x1"};
  app.add_option("--count", count, "random patterns");
  app.add_option("candidates", names, "UNITSxUNITSxSTEP");
  CLI11_PARSE(app, argc, argv);
  std::vector<Candidate> candidates = {{}};
  for (const std::string& name : names) {
    Candidate candidate;
    if (std::sscanf(name.c_str(), "%dx%dx%lf", &candidate.units_x, &candidate.units_y, &candidate.step_scale) != 3)
      return 2;
    candidates.push_back(candidate);
  }
  RandomStream random(7, "fidelity study");
  std::vector<std::vector<double>> toughness(candidates.size());
  std::vector<double> seconds(candidates.size());
  for (int i = 0; i < count; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    const tester::Simulation simulation{
        .design = pattern, .parameters = material::default_parameters(), .conditions = {}};
    fmt::print("{} {:4.2f}", pattern.key(), pattern.rigid_fraction());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const Outcome outcome = pull(simulation, candidates[c]);
      toughness[c].push_back(outcome.toughness_pa);
      seconds[c] += outcome.seconds / count;
      fmt::print("  {:7.4f} MPa {:6.2f} s", outcome.toughness_pa * 1e-6, outcome.seconds);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    double log_ratio = 0.0;
    for (int i = 0; i < count; ++i)
      log_ratio +=
          std::log(toughness[c][static_cast<std::size_t>(i)] / toughness[0][static_cast<std::size_t>(i)]) / count;
    fmt::print("{:8}  {:6.3f} s  Spearman {:.3f}  mean ratio {:.3f}\n", c == 0 ? "full" : names[c - 1], seconds[c],
               spearman(toughness[c], toughness[0]), std::exp(log_ratio));
  }
}
