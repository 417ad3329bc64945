// Discretisation floor of the testers: features on elements of size h against h/2 at the same fracture energy, over
// random and front-like layouts and several parameter sets, after a base refit. Finished fracture tests are kept in a
// table, so that the study goes on where it stopped. Results: data/discretisation_floor.toml,
// docs/studies/discretisation-floor.md; of means over specimens docs/studies/toughness.md.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "expectation_floor.hpp"
#include "study/study_command.hpp"
#include "toughness_floor.hpp"

namespace {

using namespace nacre;
using namespace nacre::discretisation_floor;

struct Options : FloorOptions {
  int sets_per_layout = 5;
  std::string output;
  SpecimenPlan compared;
  material::FailureCriterion criterion = material::base_criterion();
  std::string criterion_name{material::to_string(criterion.kind)};
  double strength_cv = material::base_strength_cv();
};

FloorPlan plan_from(const Options& options) {
  const auto kind = material::criterion_from_string(options.criterion_name);
  if (!kind) throw InputError::format("--criterion: {}", kind.error().message);
  material::FailureCriterion criterion = options.criterion;
  criterion.kind = *kind;
  if (const std::string fault = material::criterion_fault(criterion); !fault.empty()) throw InputError(fault);
  if (!material::is_strength_cv(options.strength_cv))
    throw InputError::format("--strength-cv {}: expected 0 or {} to {}", options.strength_cv,
                             material::kSmallestStrengthCv, material::kLargestStrengthCv);
  FloorPlan plan = with_criterion(plan_of(options), criterion, options.strength_cv);
  plan.sets_per_layout = std::min(options.sets, options.sets_per_layout);
  return plan;
}

/// The table for people, from what is finished.
void run_expectation(const Options& options, const FloorPlan& plan, study::StudyTable& table) {
  SpecimenPlan specimens = options.compared;
  specimens.coarse = options.specimens;
  if (specimens.fine == 0) specimens.fine = specimens.coarse;
  const int missing =
      study::fill(table, wanted_specimens(plan, specimens), options.table.seconds, options.table.threads);
  const std::vector<DesignPair> designs = finished_designs(plan, specimens, table);
  fmt::print("{}, {}, strength_cv {}, {} designs, {} specimens on h/{}, {} on h/{}\n{}", options.fidelity,
             options.criterion_name, options.strength_cv, designs.size(), specimens.coarse, specimens.refinement,
             specimens.fine, 2 * specimens.refinement, expectation_table(designs, options.table.seed));
  if (missing > 0) fmt::print(stderr, "{} fracture tests are still missing: run it again\n", missing);
}

/// The table of data/discretisation_floor.toml.
void run_floor(const Options& options, const FloorPlan& plan, study::StudyTable& table) {
  const int missing = study::fill(table, wanted_fracture_tests(plan), options.table.seconds, options.table.threads);
  if (missing > 0) fmt::print(stderr, "{} fracture tests are still missing: run it again\n", missing);
  if (missing > 0 && options.output.empty()) return;
  const ModulusFloor moduli = modulus_floor(plan, options.table.threads);
  const std::string text =
      fmt::format("[{}]\n{}{}", options.fidelity, to_toml(moduli, plan), to_toml(toughness_floor(plan, table, moduli)));
  fmt::print("{}", text);
  if (!options.output.empty()) write_file_atomically(options.output, text);
}

void run(const Options& options, bool compares_means) {
  const FloorPlan plan = plan_from(options);
  study::StudyTable table(options.table.table, kToughnessColumns);
  compares_means ? run_expectation(options, plan, table) : run_floor(options, plan, table);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Discretisation floor: the testers on elements of size h against h/2"};
  Options options;
  bool compares_means = false;
  options.table.table = "discretisation_floor.csv";
  add_options(app, options);
  app.add_option("--sets-per-layout", options.sets_per_layout, "Of a fracture test: each layout gets so many, in turn")
      ->check(CLI::Range(1, 100));
  app.add_option("--strength-cv", options.strength_cv, "Variation of W between regions")->capture_default_str();
  app.add_option("--criterion", options.criterion_name, "element, neighbourhood or crack_band")->capture_default_str();
  app.add_option("--radius", options.criterion.radius_m, "Of the neighbourhood, m")->capture_default_str();
  app.add_option("--softening", options.criterion.softening, "v0 of the crack band")->capture_default_str();
  app.add_flag("--means", compares_means, "Compare means over specimens, with intervals, and print the table alone");
  app.add_option("--fine-specimens", options.compared.fine, "On the finer mesh, with --means; as many by default")
      ->check(CLI::Range(1, 1000));
  app.add_option("--refine", options.compared.refinement, "With --means: the coarser mesh has elements of h / so many")
      ->check(CLI::Range(1, 4));
  app.add_option("--out", options.output, "TOML file to write, from what is finished");
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options, compares_means); });
}
