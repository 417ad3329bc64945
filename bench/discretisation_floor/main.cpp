// Discretisation floor of the testers: features on elements of size h against h/2 at the same fracture energy, over
// random and front-like layouts and several parameter sets, after a base refit. Finished fracture tests are kept in a
// table, so that the study goes on where it stopped. Results: data/discretisation_floor.toml,
// docs/studies/discretisation-floor.md.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "study/study_command.hpp"
#include "toughness_floor.hpp"

namespace {

using namespace nacre;
using namespace nacre::discretisation_floor;

struct Options : FloorOptions {
  int sets_per_layout = 5;
  std::string output;
};

void run(const Options& options) {
  FloorPlan plan = plan_of(options);
  plan.sets_per_layout = std::min(options.sets, options.sets_per_layout);
  study::StudyTable table(options.table.table, kToughnessColumns);
  const int missing = study::fill(table, wanted_fracture_tests(plan), options.table.seconds, options.table.threads);
  if (missing > 0) fmt::print(stderr, "{} fracture tests are still missing: run it again\n", missing);
  if (missing > 0 && options.output.empty()) return;
  const ModulusFloor moduli = modulus_floor(plan, options.table.threads);
  const std::string text =
      fmt::format("[{}]\n{}{}", options.fidelity, to_toml(moduli, plan), to_toml(toughness_floor(plan, table, moduli)));
  fmt::print("{}", text);
  if (!options.output.empty()) write_file_atomically(options.output, text);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Discretisation floor: the testers on elements of size h against h/2"};
  Options options;
  options.table.table = "discretisation_floor.csv";
  add_options(app, options);
  app.add_option("--sets-per-layout", options.sets_per_layout, "Of a fracture test: each layout gets so many, in turn")
      ->check(CLI::Range(1, 100));
  app.add_option("--out", options.output, "TOML file to write, from what is finished");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
