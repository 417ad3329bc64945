// What the testers' elements leave of an error: features on elements of size h against h/2 at shared fracture energy, over
// random and front-like layouts and several parameter sets, after a base refit. Finished fracture tests are kept in a
// table, so that the study goes on where it stopped. Results: data/numerics_floor.toml, docs/studies/numerics-floor.md.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "base/result.hpp"
#include "toughness_floor.hpp"

namespace {

using namespace nacre;
using namespace nacre::numerics_floor;

struct Options {
  int layouts = 48, sets = 5, threads = 0;
  std::uint64_t seed = 1;
  double seconds = 1e9;
  std::string fidelity = "preview", gamut = "bench/numerics_floor/gamut.csv", table = "numerics_floor.csv", output;
};

void run(const Options& options) {
  const Plan plan{.fidelity = *tester::fidelity_from_string(options.fidelity),
                  .seed = options.seed,
                  .layouts = floor_layouts(options.layouts, options.gamut, options.seed),
                  .sets = floor_parameter_sets(options.sets, options.seed)};
  study::StudyTable table(options.table, kToughnessColumns);
  const int missing = study::fill(table, wanted_fracture_tests(plan), options.seconds, options.threads);
  if (missing > 0) fmt::print(stderr, "{} fracture tests are still missing: run it again\n", missing);
  if (missing > 0 && options.output.empty()) return;
  const ModulusFloor moduli = modulus_floor(plan, options.threads);
  const std::string text = fmt::format("[{}]\n{}{}", options.fidelity, to_toml(moduli, plan),
                                       to_toml(toughness_floor(plan, table, moduli)));
  fmt::print("{}", text);
  if (!options.output.empty()) write_file_atomically(options.output, text);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Numerics floor: the testers on elements of size h against h/2"};
  Options options;
  app.add_option("--layouts", options.layouts, "Half random (50-85 % rigid), half the best of the gamut")->check(CLI::Range(12, 1000));
  app.add_option("--sets", options.sets, "Parameter sets, the defaults first")->check(CLI::Range(1, 100));
  app.add_option("--gamut", options.gamut, "gamut.csv of nacre explore")->check(CLI::ExistingFile);
  app.add_option("--fidelity", options.fidelity)->check(CLI::IsMember({"tiny", "preview", "full"}));
  app.add_option("--seed", options.seed, "Of layouts and parameter sets");
  app.add_option("--table", options.table, "CSV of finished fracture tests, read and continued");
  app.add_option("--seconds", options.seconds, "Begin no fracture test after this time");
  app.add_option("--threads", options.threads, "0: all allowed cores")->check(CLI::Range(0, 1024));
  app.add_option("--out", options.output, "TOML file to write, from what is finished");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
