// Discretisation floor of the testers: features on elements of size h against h/2 at the same fracture energy, over
// random and front-like layouts and several parameter sets, after a base refit. Finished fracture tests are kept in a
// table, so that the study goes on where it stopped. Results: data/discretisation_floor.toml,
// docs/studies/discretisation-floor.md; of means over specimens docs/studies/toughness.md.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "expectation_floor.hpp"
#include "study/study_command.hpp"
#include "tester/strength_field.hpp"
#include "toughness_floor.hpp"

namespace {

using namespace nacre;
using namespace nacre::discretisation_floor;

struct Options : FloorOptions {
  int sets_per_layout = 5;
  std::string output;
  SpecimenPlan specimens;
  std::string criterion = "element";
};

/// Of means over specimens alone: the table for people, from what is finished.
void run_expectation(const Options& options, const FloorPlan& plan, study::StudyTable& table) {
  SpecimenPlan specimens = options.specimens;
  if (specimens.fine == 0) specimens.fine = specimens.coarse;
  if (!material::is_strength_cv(specimens.strength_cv) || specimens.strength_cv == 0.0)
    throw InputError::format("--strength-cv {}: expected {} to {}", specimens.strength_cv,
                             material::kSmallestStrengthCv, material::kLargestStrengthCv);
  const auto criterion = material::criterion_from_string(options.criterion);
  if (!criterion) throw InputError::format("--criterion: {}", criterion.error().message);
  specimens.criterion.kind = *criterion;
  if (const std::string fault = material::criterion_fault(specimens.criterion); !fault.empty()) throw InputError(fault);
  const int missing =
      study::fill(table, wanted_specimens(plan, specimens), options.table.seconds, options.table.threads);
  const std::vector<DesignPair> designs = finished_designs(plan, specimens, table);
  fmt::print("{}, {}, strength_cv {}, {} designs, {} specimens on h/{}, {} on h/{}\n{}", options.fidelity,
             options.criterion, specimens.strength_cv, designs.size(), specimens.coarse, specimens.refinement,
             specimens.fine, 2 * specimens.refinement, expectation_table(designs, options.table.seed));
  if (missing > 0) fmt::print(stderr, "{} fracture tests are still missing: run it again\n", missing);
}

void run(const Options& options) {
  FloorPlan plan = plan_of(options);
  plan.sets_per_layout = std::min(options.sets, options.sets_per_layout);
  study::StudyTable table(options.table.table, kToughnessColumns);
  if (options.specimens.coarse > 0) return run_expectation(options, plan, table);
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
  app.add_option("--specimens", options.specimens.coarse, "Compare means over so many specimens of a design instead")
      ->check(CLI::Range(1, 1000));
  app.add_option("--fine-specimens", options.specimens.fine, "On the finer mesh; as many by default")
      ->check(CLI::Range(1, 1000));
  app.add_option("--strength-cv", options.specimens.strength_cv, "Variation of W between their regions")
      ->capture_default_str();
  app.add_option("--criterion", options.criterion, "element, neighbourhood or crack_band")->capture_default_str();
  app.add_option("--radius", options.specimens.criterion.radius_m, "Of the neighbourhood, m")->capture_default_str();
  app.add_option("--softening", options.specimens.criterion.softening, "v0 of the crack band")->capture_default_str();
  app.add_option("--tail", options.specimens.tail, "Size of progressive_damage beside the criterion")
      ->check(CLI::Range(0.1, 10.0));
  app.add_option("--strength-factor", options.specimens.strength_factor, "On every W, in a comparison of specimens")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--refine", options.specimens.refinement, "The coarser mesh has elements of h / so many")
      ->check(CLI::Range(1, 4));
  app.add_option("--out", options.output, "TOML file to write, from what is finished");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
