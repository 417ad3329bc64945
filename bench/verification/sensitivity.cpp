// Sensitivity of T to the numerical method: damping, strain rate, time step, number type. Results:
// docs/studies/verification.md.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/statistics.hpp"
#include "fracture_row.hpp"
#include "study/study_command.hpp"
#include "study/study_table.hpp"

namespace {

using namespace nacre;
using namespace nacre::verification;

struct Options {
  int patterns = 10;
  std::string fidelity = "preview";
  study::TableOptions table{.table = "sensitivity.csv"};
};

/// A fracture test that differs from the tester's in one setting.
struct TesterVariant {
  std::string name;
  double gamma_scale = 1.0;
  tester::Discretisation discretisation = {};
  bool double_precision = false;
};

std::vector<TesterVariant> variants() {
  std::vector<TesterVariant> list = {{.name = "the tester"}};
  for (const double scale : {0.1, 0.3, 3.0, 10.0})
    list.push_back({.name = fmt::format("gamma x {:g}", scale), .gamma_scale = scale});
  for (const double scale : {0.5, 2.0, 4.0})
    list.push_back({.name = fmt::format("strain rate x {:g}", scale), .discretisation = {.rate_scale = scale}});
  list.push_back({.name = "time step x 0.5", .discretisation = {.time_step_scale = 0.5}});
  list.push_back({.name = "double precision", .double_precision = true});
  return list;
}

std::string key_of(const Options& options, const pattern::Pattern& pattern, const TesterVariant& variant) {
  return fmt::format("{} {} {} {}", options.fidelity, options.table.seed, pattern.key(), variant.name);
}

Result<tester::ToughnessResult> pull(const pattern::Pattern& pattern, const TesterVariant& variant,
                                     tester::Fidelity fidelity) {
  tester::Simulation simulation{pattern, material::default_parameters(), {}, fidelity};
  simulation.parameters.toughness.gamma_per_s *= variant.gamma_scale;
  const tester::FractureTest test = tester::fracture_test(simulation, variant.discretisation);
  return variant.double_precision ? tester::run_fracture_test<double>(test) : tester::run_fracture_test<float>(test);
}

void print_row(const Options& options, const std::vector<pattern::Pattern>& patterns, const study::StudyTable& table,
               const TesterVariant& variant) {
  std::vector<double> ratios, sizes, own, reference;
  for (const pattern::Pattern& pattern : patterns) {
    const auto row = table.find(key_of(options, pattern, variant)),
               base = table.find(key_of(options, pattern, {"the tester"}));
    if (!row || !base || (*row)[0] <= 0.0 || (*base)[0] <= 0.0) continue;
    own.push_back((*row)[0]);
    reference.push_back((*base)[0]);
    ratios.push_back(std::log(own.back() / reference.back()));
    sizes.push_back(std::abs(own.back() / reference.back() - 1.0));
  }
  if (ratios.empty()) return;
  fmt::print("| {} | {} | {:+.3f} | {:.3f} | {:.2f} % | {:.1f} % | {:.3f} |\n", variant.name, ratios.size(),
             mean(ratios), standard_deviation(ratios), 100.0 * quantile(sizes, 0.5), 100.0 * quantile(sizes, 1.0),
             rank_correlation(own, reference));
}

void run(const Options& options) {
  const std::vector<pattern::Pattern> patterns = study_patterns(options.patterns, options.table.seed);
  const tester::Fidelity fidelity = *tester::fidelity_from_string(options.fidelity);
  study::StudyTable table(options.table.table, kFractureColumns);
  std::vector<study::Wanted> wanted;
  for (const pattern::Pattern& pattern : patterns)
    for (const TesterVariant& variant : variants()) {
      const std::string key = key_of(options, pattern, variant);
      wanted.push_back({key, [=] { return fracture_row(key, pull(pattern, variant, fidelity)); }});
    }
  const int missing = study::fill(table, wanted, options.table.seconds, options.table.threads);
  fmt::print("{}: T against that of the tester\n\n", options.fidelity);
  fmt::print("| variant | patterns | mean of log ratio | sd | median change | largest change | Spearman |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const TesterVariant& variant : variants()) print_row(options, patterns, table, variant);
  if (missing > 0) fmt::print("\n{} simulations are still missing: run it again\n", missing);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Sensitivity of T to damping, strain rate, time step and precision"};
  Options options;
  app.add_option("--patterns", options.patterns, "Patterns")->check(CLI::Range(2, 1000));
  study::add_fidelity_option(app, options.fidelity);
  study::add_table_options(app, options.table, "the patterns");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
