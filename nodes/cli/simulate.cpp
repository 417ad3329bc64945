// Part of the command line (command.hpp): nacre simulate, the two testers on patterns, without farm and cache.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/processor_time.hpp"
#include "command.hpp"
#include "film/film_file.hpp"
#include "film_files.hpp"
#include "material/extensions.hpp"
#include "material/parameters.hpp"
#include "measurement/set_files.hpp"
#include "output.hpp"
#include "output_path.hpp"
#include "pattern/constraints.hpp"
#include "pattern/design.hpp"
#include "progress.hpp"
#include "simulated_design.hpp"
#include "tester/refinement.hpp"
#include "tester/strength_field.hpp"

namespace nacre::cli {
namespace {

struct Options {
  std::vector<std::string> patterns;
  std::string params;
  std::string test = "both";
  std::string fidelity = "full";
  std::string curves;
  std::string frames;
  std::string film;
  int frame_count = film::kFrames;
  int film_width = 960;
  SpecimenChoice choice;
  std::string criterion;
  std::optional<double> strength_cv;
  bool json = false;

  bool wants_films() const { return !frames.empty() || !film.empty(); }
};

std::vector<SimulatedDesign> read_designs(const std::vector<std::string>& arguments) {
  std::vector<SimulatedDesign> designs;
  for (const std::string& argument : arguments) {
    SimulatedDesign& simulated = designs.emplace_back();
    simulated.argument = argument;
    simulated.design = pattern::design_from_argument(argument);
    const pattern::Layout* layout = simulated.design.layout();
    if (layout == nullptr) continue;
    const auto symmetric = pattern::Pattern::from_layout(*layout);
    const auto violation =
        symmetric ? pattern::violation(*symmetric) : "it lacks the eightfold symmetry of nacre's proposals";
    if (violation) warn(fmt::format("{}: {}; it is simulated all the same", argument, *violation));
  }
  return designs;
}

/// Pulls specimen 0 once more for its film, and writes what was asked for.
void film_specimen(const SimulatedDesign& simulated, const tester::Simulation& simulation, const Options& options) {
  const Result<film::Film> film = film::record_film(simulation, *simulated.pulled.front(), options.frame_count);
  const std::string stem = file_stem(simulated.design.name());
  if (!film) throw InputError::format("{}: no film: {}", simulated.argument, film.error().message);
  if (!options.frames.empty()) film::write_film(std::filesystem::path(options.frames) / (stem + ".film"), *film);
  if (!options.film.empty()) draw_film(*film, options.film, stem, options.film_width);
}

/// Whether none before it is the same design: files are named after designs, and written once.
bool is_first(const SimulatedDesign& simulated, const std::vector<SimulatedDesign>& designs) {
  return &*std::ranges::find(designs, simulated.design, &SimulatedDesign::design) == &simulated;
}

tester::Simulation simulation_of(const SimulatedDesign& simulated, const Options& options,
                                 const material::ParameterSet& parameters) {
  return {.design = simulated.design,
          .parameters = tester::refined(parameters, options.choice.refine),
          .conditions = {},
          .fidelity = fidelity_from_option(options.fidelity)};
}

void pull_specimen(SimulatedDesign& simulated, tester::Simulation simulation, std::size_t specimen,
                   const Options& options) {
  const double begun_s = processor_time_s();
  simulation.specimen = static_cast<int>(specimen);
  simulated.pulled[specimen] = tester::test_toughness(simulation, {.refinement = options.choice.refine});
  simulated.kernel_s[specimen] = processor_time_s() - begun_s;
}

/// What the broken specimens tell together, and the crack of the first; a refined crack counts other elements.
void sum_up(SimulatedDesign& simulated, const tester::Simulation& simulation, const Options& options) {
  std::vector<tester::ToughnessResult> broken;
  for (const Result<tester::ToughnessResult>& each : simulated.pulled)
    if (each) broken.push_back(*each);
  if (broken.empty() || broken.size() < simulated.pulled.size()) return;
  simulated.toughness = tester::expected_toughness_of(std::move(broken));
  if (options.choice.refine > 1) return;
  simulated.crack = crack::record_of(simulation, simulated.pulled.front()->breaks);
  simulated.mechanisms = crack::mechanisms_of(simulation, *simulated.crack);
}

/// A test of a design; the number of its specimen counts in a toughness test alone.
struct SpecimenTest {
  SimulatedDesign* simulated;
  tester::TestKind test;
  int specimen = 0;
};

/// The long tests first.
std::vector<SpecimenTest> wanted_tests(std::vector<SimulatedDesign>& designs, const Options& options) {
  std::vector<SpecimenTest> tests;
  if (options.test != "modulus") {
    for (SimulatedDesign& simulated : designs) {
      const auto count = static_cast<std::size_t>(options.choice.count);
      simulated.pulled.assign(count, fail("not tested"));
      simulated.kernel_s.assign(count, 0.0);
      for (int i = 0; i < options.choice.count; ++i) tests.push_back({&simulated, tester::TestKind::toughness, i});
    }
  }
  if (options.test != "toughness")
    for (SimulatedDesign& simulated : designs) tests.push_back({&simulated, tester::TestKind::modulus});
  return tests;
}

void run_tests(std::vector<SimulatedDesign>& designs, const Options& options,
               const material::ParameterSet& parameters) {
  const std::vector<SpecimenTest> tests = wanted_tests(designs, options);
  Progress progress("simulate: tests", static_cast<std::int64_t>(tests.size()));
  parallel_for(static_cast<int>(tests.size()), [&](int i) {
    const SpecimenTest& each = tests[static_cast<std::size_t>(i)];
    const tester::Simulation simulation = simulation_of(*each.simulated, options, parameters);
    if (each.test == tester::TestKind::modulus)
      each.simulated->modulus = tester::test_modulus(simulation, {.refinement = options.choice.refine});
    else
      pull_specimen(*each.simulated, simulation, static_cast<std::size_t>(each.specimen), options);
    progress.advance();
  });
  parallel_for(static_cast<int>(designs.size()), [&](int i) {
    SimulatedDesign& simulated = designs[static_cast<std::size_t>(i)];
    const tester::Simulation simulation = simulation_of(simulated, options, parameters);
    sum_up(simulated, simulation, options);
    if (simulated.toughness && options.wants_films() && is_first(simulated, designs))
      film_specimen(simulated, simulation, options);
  });
}

/// One curve a specimen: KEY.csv, of several KEY-0.csv, KEY-1.csv, ...
void write_curves(const std::vector<SimulatedDesign>& designs, const Options& options) {
  if (options.curves.empty()) return;
  for (const SimulatedDesign& simulated : designs)
    for (std::size_t i = 0; i < simulated.pulled.size(); ++i) {
      if (!simulated.pulled[i]) continue;
      const std::string number = options.choice.count > 1 ? fmt::format("-{}", i) : "";
      write_file_atomically(
          std::filesystem::path(options.curves) / (file_stem(simulated.design.name()) + number + ".csv"),
          measurement::to_csv(simulated.pulled[i]->curve));
    }
}

/// The parameter file's, or what the options say instead.
material::ParameterSet model_of(const Options& options) {
  material::FailureCriterion criterion;
  if (!options.criterion.empty()) criterion.kind = *material::criterion_from_string(options.criterion);
  material::ParameterSet model = parameters_from_option(options.params, material::default_parameters(criterion));
  if (!options.criterion.empty()) model.criterion.kind = criterion.kind;
  if (options.strength_cv) model.strength_cv = *options.strength_cv;
  if (!material::is_strength_cv(model.strength_cv))
    throw InputError::format("--strength-cv {}: expected 0 or {} to {}", model.strength_cv,
                             material::kSmallestStrengthCv, material::kLargestStrengthCv);
  return model;
}

/// Before anything is computed: the specimens that were asked for exist.
void check_specimen_options(const Options& options, const material::ParameterSet& parameters) {
  if (options.choice.refine > 1 && options.wants_films())
    throw InputError("--frames and --film show unrefined elements: leave out --refine");
  if (options.choice.count > 1 && !tester::specimens_differ(parameters))
    warn(fmt::format("--specimens {}: without --strength-cv they are all alike", options.choice.count));
  if (options.choice.count > 1 && options.wants_films()) remark("films show specimen 0, T is the mean over specimens");
}

/// Before anything is computed: a GIF shows one specimen, and the outputs can be written.
void check_output_options(const Options& options) {
  if ((options.wants_films() || !options.curves.empty()) && options.test == "modulus")
    throw InputError("--curves, --frames and --film show the toughness test: --test modulus does not run it");
  if (!options.curves.empty()) prepare_output_folder(options.curves);
  if (!options.frames.empty()) prepare_output_folder(options.frames);
  if (options.film.empty()) return;
  if (is_gif(options.film) && options.patterns.size() > 1)
    throw InputError::format("--film {}: a GIF shows one specimen, not {}; name a folder for pictures of all",
                             options.film, options.patterns.size());
  prepare_film_output(options.film);
}

int simulate(const Options& given) {
  Options options = given;
  std::vector<SimulatedDesign> designs = read_designs(options.patterns);
  const material::ParameterSet parameters = model_of(options);
  options.choice.criterion = parameters.criterion;
  options.choice.strength_cv = parameters.strength_cv;
  check_specimen_options(options, parameters);
  check_output_options(options);
  run_tests(designs, options, parameters);
  write_curves(designs, options);
  bool any_succeeded = false;
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const SimulatedDesign& simulated : designs) {
    any_succeeded = any_succeeded || simulated.failure().empty();
    document.push_back(to_json(simulated, options.choice));
  }
  options.json ? print_json(document) : print_table(designs, options.choice);
  return any_succeeded ? 0 : 1;
}

}  // namespace

void add_simulate(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = add_command(app, action, "simulate",
                                  "Simulate the stiffness test and the toughness test of patterns", options, simulate);
  command.add_option("PATTERN", options->patterns, kDesignWords)->required();
  command.add_option("--params", options->params, "Parameter file of the model; default: the built-in parameters");
  command.add_option("--test", options->test, "Which test to simulate")
      ->check(CLI::IsMember({"modulus", "toughness", "both"}))
      ->capture_default_str();
  add_fidelity(command, options->fidelity)->capture_default_str();
  command.add_option("--specimens", options->choice.count, "T is the mean over so many specimens of each pattern")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_option("--strength-cv", options->strength_cv,
                     "Variation of failure energy between regions of half a pixel: 0, or 0.02 to 0.4; default: the "
                     "model's");
  command
      .add_option("--criterion", options->criterion, "When elements fail in the toughness test; default: the model's")
      ->check(CLI::IsMember({"element", "neighbourhood", "crack_band"}));
  command.add_option("--refine", options->choice.refine, "Elements of 1/K, with the same specimens")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command.add_option("--curves", options->curves, "Folder for the stress-strain curves, one KEY.csv a specimen");
  command.add_option("--frames", options->frames,
                     "Folder for fracture films as data, one KEY.film each (docs/FORMATS.md)");
  command.add_option("--film", options->film, "GIF that shows one specimen break, or folder for pictures KEY-NNNN.png");
  command.add_option("--film-width", options->film_width, "Width of the film's pictures in pixels")
      ->check(CLI::Range(kNarrowestPicture, kWidestPicture))
      ->capture_default_str();
  command.add_option("--frame-count", options->frame_count, "Pictures per film")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
