// How well a smaller or faster fracture test ranks designs by toughness against the thesis' geometry at 20 /s, and what
// it costs. Every finished simulation is a line of the table, so that an interrupted study can be continued.
// Results: docs/studies/fidelity.md.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/parallel.hpp"
#include "base/processor_time.hpp"
#include "base/random.hpp"
#include "base/statistics.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/fracture_test.hpp"
#include "tester/notch.hpp"

namespace {

using namespace nacre;

constexpr int kResamples = 1000;
constexpr double kManyRigid = 0.75;  // proposals lie above it

/// A fracture test of UNITSxUNITS pulled at RATE times 20 /s; the time step is the thesis' or, where `free`, what
/// stability allows.
struct TestVariant {
  std::string name;
  int units_x = 5, units_y = 4;
  double rate = 1.0;
  bool free_step = false;
};

TestVariant parse_variant(const std::string& name) {
  TestVariant variant{.name = name};
  char step[8] = "";
  if (std::sscanf(name.c_str(), "%dx%dx%lf%7s", &variant.units_x, &variant.units_y, &variant.rate, step) < 3)
    throw CLI::ValidationError("variant '" + name + "': expected UNITSxUNITSxRATE or UNITSxUNITSxRATEfree");
  variant.free_step = std::string(step) == "free";
  return variant;
}

struct FractureOutcome {
  double toughness_pa = 0.0, cpu_s = 0.0;
};

Result<FractureOutcome> pull(const pattern::Pattern& pattern, const TestVariant& variant) {
  const double start = processor_time_s();
  const tester::Simulation simulation{
      .design = pattern,
      .parameters = material::default_parameters(),
      .conditions = {},
      // The presets differ in their time step only where this program does not set it.
      .fidelity = variant.free_step ? tester::Fidelity::preview : tester::Fidelity::full};
  const tester::Discretisation discretisation{.rate_scale =
                                                  variant.rate / tester::loading_rate_scale(simulation.fidelity)};
  tester::FractureTest test = tester::fracture_test(simulation, discretisation);
  test.grid = tester::assemble(simulation.design, simulation.parameters, simulation.conditions,
                               tester::AssemblyTarget::toughness, variant.units_x, variant.units_y);
  tester::cut_notch(test.grid, 1);
  const Result<tester::ToughnessResult> result = tester::run_fracture_test<float>(test);
  if (!result) return tl::unexpected(result.error());
  return FractureOutcome{.toughness_pa = result->toughness_pa, .cpu_s = processor_time_s() - start};
}

/// 120 patterns over the strata of Table 3.2 and 80 of 76 to 85 % rigid, mixed so that every share of them is fair.
std::vector<pattern::Pattern> study_patterns(std::uint64_t seed) {
  RandomStream random(seed, "fidelity");
  const std::vector<pattern::Pattern> strata = pattern::stratified_patterns(120, random);
  std::vector<pattern::Pattern> rigid;
  for (int i = 0; i < 80; ++i) rigid.push_back(pattern::random_pattern(76 + i % 10, random));
  std::vector<pattern::Pattern> mixed;
  for (std::size_t i = 0; i < 40; ++i) {
    mixed.insert(mixed.end(), strata.begin() + static_cast<long>(3 * i), strata.begin() + static_cast<long>(3 * i + 3));
    mixed.insert(mixed.end(), rigid.begin() + static_cast<long>(2 * i), rigid.begin() + static_cast<long>(2 * i + 2));
  }
  return mixed;
}

using OutcomeTable = std::map<std::pair<std::string, std::string>, FractureOutcome>;  // variant, pattern

OutcomeTable read_table(const std::string& path) {
  OutcomeTable table;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string variant, key, rigid, toughness, seconds;
    if (std::getline(fields, variant, ',') && std::getline(fields, key, ',') && std::getline(fields, rigid, ',') &&
        std::getline(fields, toughness, ',') && std::getline(fields, seconds))
      table[{variant, key}] = {std::stod(toughness), std::stod(seconds)};
  }
  return table;
}

/// Pulls what the table lacks and appends it.
void fill_table(OutcomeTable& table, const std::string& path, const std::vector<pattern::Pattern>& patterns,
                const TestVariant& variant, int threads) {
  std::ofstream file(path, std::ios::app);
  std::mutex mutex;
  parallel_for(
      static_cast<int>(patterns.size()),
      [&](int i) {
        const pattern::Pattern& pattern = patterns[i];
        {
          const std::lock_guard lock(mutex);
          if (table.contains({variant.name, pattern.key()})) return;
        }
        const Result<FractureOutcome> outcome = pull(pattern, variant);
        const std::lock_guard lock(mutex);
        if (!outcome) {
          fmt::print(stderr, "{} {}: {}\n", variant.name, pattern.key(), outcome.error().message);
          return;
        }
        table[{variant.name, pattern.key()}] = *outcome;
        file << fmt::format("{},{},{:.2f},{:.6g},{:.4g}\n", variant.name, pattern.key(), pattern.rigid_fraction(),
                            outcome->toughness_pa, outcome->cpu_s)
             << std::flush;
      },
      threads);
}

/// Spearman's correlation and the quantile of its bootstrap that 90 % of the resamples exceed.
struct RankAgreement {
  double spearman = 0.0, lower_90 = 0.0;
};

RankAgreement rank_agreement(const std::vector<double>& a, const std::vector<double>& b) {
  RandomStream random(1, "fidelity bootstrap");
  std::vector<double> resampled;
  for (int i = 0; i < kResamples; ++i) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const auto pick = static_cast<std::size_t>(random.index(static_cast<int>(a.size())));
      x.push_back(a[pick]);
      y.push_back(b[pick]);
    }
    resampled.push_back(rank_correlation(x, y));
  }
  return {.spearman = rank_correlation(a, b), .lower_90 = quantile(resampled, 0.1)};
}

void print_agreement(const OutcomeTable& table, const std::vector<pattern::Pattern>& patterns,
                     const TestVariant& variant, const TestVariant& reference, double minimum_rigid) {
  std::vector<double> values, references, log_ratios;
  double seconds = 0.0;
  for (const pattern::Pattern& pattern : patterns) {
    if (pattern.rigid_fraction() <= minimum_rigid) continue;
    const auto value = table.find({variant.name, pattern.key()}), full = table.find({reference.name, pattern.key()});
    if (value == table.end() || full == table.end()) continue;
    values.push_back(value->second.toughness_pa);
    references.push_back(full->second.toughness_pa);
    log_ratios.push_back(std::log(values.back() / references.back()));
    seconds += value->second.cpu_s;
  }
  if (values.size() < 3) return;
  const RankAgreement agreement = rank_agreement(values, references);
  fmt::print("| {} | {} | {} | {:.3f} | {:.3f} | {:+.3f} | {:.3f} | {:.2f} |\n", variant.name,
             minimum_rigid > 0.0 ? "above 75 %" : "all", values.size(), agreement.spearman, agreement.lower_90,
             mean(log_ratios), standard_deviation(log_ratios), seconds / static_cast<double>(values.size()));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Ranks designs by toughness in smaller or faster fracture tests against the thesis'"};
  int count = 200, threads = 0;
  std::uint64_t seed = 2026;
  std::string path = "fidelity_presets.csv";
  std::vector<std::string> names = {"5x4x2free"};
  app.add_option("--count", count, "patterns")->check(CLI::Range(3, 200))->capture_default_str();
  app.add_option("--seed", seed, "seed of the patterns")->capture_default_str();
  app.add_option("--table", path, "table of finished simulations")->capture_default_str();
  app.add_option("--threads", threads, "0: all allowed cores")->capture_default_str();
  app.add_option("variants", names, "UNITSxUNITSxRATE, with 'free' behind for the longest stable time step");
  CLI11_PARSE(app, argc, argv);
  const TestVariant reference{.name = "5x4x1"};
  std::vector<TestVariant> variants = {reference};
  try {
    for (const std::string& name : names) variants.push_back(parse_variant(name));
  } catch (const CLI::Error& error) {
    return app.exit(error);
  }
  std::vector<pattern::Pattern> patterns = study_patterns(seed);
  patterns.erase(patterns.begin() + count, patterns.end());
  OutcomeTable table = read_table(path);
  for (const TestVariant& variant : variants) {
    fmt::print(stderr, "{}: {} patterns\n", variant.name, patterns.size());
    fill_table(table, path, patterns, variant, threads);
  }
  fmt::print(
      "| variant | rigid fraction | patterns | Spearman | lower 90 % | mean log ratio | sd of log ratio | CPU s |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const TestVariant& variant : variants) {
    print_agreement(table, patterns, variant, reference, 0.0);
    print_agreement(table, patterns, variant, reference, kManyRigid);
  }
}
