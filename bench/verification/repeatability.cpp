// Spread of the toughness of a design under perturbations of its parameters that are smaller than their uncertainty: T
// is discontinuous, because which element fails next may turn on the last digit. Results:
// docs/studies/repeatability.md, data/discretisation_floor.toml.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/random.hpp"
#include "base/statistics.hpp"
#include "fracture_row.hpp"
#include "study/study_command.hpp"
#include "study/study_table.hpp"

namespace {

using namespace nacre;
using namespace nacre::verification;

constexpr double kPerturbations[] = {1e-6, 1e-5, 1e-4, 1e-3};

struct Options {
  int patterns = 12, draws = 3;
  std::string fidelity = "preview";
  study::TableOptions table{.table = "repeatability.csv"};
};

std::string key_of(const Options& options, const pattern::Pattern& pattern, double relative, int draw) {
  return fmt::format("{} {} {} {:g} {}", options.fidelity, options.table.seed, pattern.key(), relative, draw);
}

std::vector<study::Wanted> wanted_rows(const Options& options, const std::vector<pattern::Pattern>& patterns) {
  const tester::Fidelity fidelity = *tester::fidelity_from_string(options.fidelity);
  std::vector<study::Wanted> wanted;
  const auto want = [&](const pattern::Pattern& pattern, double relative, int draw) {
    const std::string key = key_of(options, pattern, relative, draw);
    wanted.push_back({key, [=] {
                        RandomStream random(1, "repeatability/" + key);
                        material::ParameterSet parameters = material::default_parameters();
                        parameters.toughness = material::perturbed(parameters.toughness, relative, random);
                        return fracture_row(key, tester::test_toughness({pattern, parameters, {}, fidelity}));
                      }});
  };
  // Pattern by pattern, so that a study cut short holds whole patterns.
  for (const pattern::Pattern& pattern : patterns) {
    want(pattern, 0.0, 0);
    for (int draw = 0; draw < options.draws; ++draw)
      for (const double relative : kPerturbations) want(pattern, relative, draw);
  }
  return wanted;
}

/// Standard deviations of log T, log peak stress and log failure strain, and the largest range of log T, between draws
/// of one perturbation; one value a pattern.
struct Deviations {
  std::vector<double> toughness, peak, strain, largest;
};

void print_row(const Options& options, const std::vector<pattern::Pattern>& patterns, const study::StudyTable& table,
               double relative) {
  Deviations sds;
  for (const pattern::Pattern& pattern : patterns) {
    std::vector<double> logs[3];
    for (int draw = -1; draw < options.draws; ++draw) {
      const auto row =
          table.find(draw < 0 ? key_of(options, pattern, 0.0, 0) : key_of(options, pattern, relative, draw));
      if (!row || (*row)[0] <= 0.0) continue;
      for (std::size_t feature = 0; feature < 3; ++feature) logs[feature].push_back(std::log((*row)[feature]));
    }
    if (static_cast<int>(logs[0].size()) < options.draws + 1) continue;
    sds.toughness.push_back(standard_deviation(logs[0]));
    sds.peak.push_back(standard_deviation(logs[1]));
    sds.strain.push_back(standard_deviation(logs[2]));
    sds.largest.push_back(*std::max_element(logs[0].begin(), logs[0].end()) -
                          *std::min_element(logs[0].begin(), logs[0].end()));
  }
  if (sds.toughness.empty()) return;
  fmt::print("| {:g} | {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} |\n", relative, sds.toughness.size(),
             root_mean_square(sds.toughness), quantile(sds.toughness, 0.5), *std::ranges::max_element(sds.largest),
             root_mean_square(sds.peak), root_mean_square(sds.strain));
}

void run(const Options& options) {
  const std::vector<pattern::Pattern> patterns = study_patterns(options.patterns, options.table.seed);
  study::StudyTable table(options.table.table, kFractureColumns);
  const int missing = study::fill(table, wanted_rows(options, patterns), options.table.seconds, options.table.threads);
  fmt::print("{}: standard deviations between runs of one pattern whose parameters differ by this much\n\n",
             options.fidelity);
  fmt::print(
      "| relative | patterns | log T (rms) | log T (median) | largest range of log T | log peak | log strain |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double relative : kPerturbations) print_row(options, patterns, table, relative);
  if (missing > 0) fmt::print("\n{} simulations are still missing: run it again\n", missing);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Repeatability of the toughness tester under tiny perturbations of its parameters"};
  Options options;
  app.add_option("--patterns", options.patterns, "Patterns")->check(CLI::Range(2, 1000));
  app.add_option("--draws", options.draws, "Perturbed runs per pattern and size")->check(CLI::Range(1, 100));
  study::add_fidelity_option(app, options.fidelity);
  study::add_table_options(app, options.table, "patterns and perturbations");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
