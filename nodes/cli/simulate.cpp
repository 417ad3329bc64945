// Part of the command line (command.hpp): nacre simulate, the two testers on patterns, without farm and cache.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/output_path.hpp"
#include "base/parallel.hpp"
#include "command.hpp"
#include "film/film_file.hpp"
#include "film_files.hpp"
#include "material/extensions.hpp"
#include "material/parameters.hpp"
#include "measurement/set_files.hpp"
#include "offline/simulate.hpp"
#include "output.hpp"
#include "pattern/design.hpp"
#include "progress.hpp"
#include "simulated_table.hpp"
#include "tester/strength_field.hpp"

namespace nacre::cli {
namespace {

using offline::SimulatedDesign;
using offline::SimulateSettings;

struct SimulateOptions {
  std::vector<std::string> patterns;
  std::string params;
  std::string test = "both";
  std::string fidelity = "full";
  std::string curves;
  std::string frames;
  std::string film;
  int frame_count = film::kFrames;
  int film_width = 960;
  offline::SpecimenChoice choice;
  offline::ModelChoice model;
  bool json = false;

  bool wants_films() const { return !frames.empty() || !film.empty(); }
};

std::vector<SimulatedDesign> read_designs(const std::vector<std::string>& arguments) {
  std::vector<SimulatedDesign> designs;
  for (const std::string& argument : arguments) {
    SimulatedDesign& simulated = designs.emplace_back();
    simulated.argument = argument;
    simulated.design = pattern::design_from_argument(argument);
    const std::string departure = offline::departure_from_proposals(simulated.design);
    if (!departure.empty()) warn(fmt::format("{}: {}; it is simulated all the same", argument, departure));
  }
  return designs;
}

/// Pulls specimen 0 once more for its film, and writes what was asked for.
void film_specimen(const SimulatedDesign& simulated, const tester::Simulation& simulation,
                   const SimulateOptions& options) {
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

/// Runs all tests, and films the specimens.
void run_tests(std::vector<SimulatedDesign>& designs, const SimulateOptions& options,
               const SimulateSettings& settings) {
  const auto count = static_cast<std::int64_t>(designs.size());
  Progress progress("simulate: tests", count * settings.tests_of_a_design());
  offline::run_tests(designs, settings, [&] { progress.advance(); });
  if (!options.wants_films()) return;
  parallel_for(count, [&](int i) {
    const SimulatedDesign& simulated = designs[static_cast<std::size_t>(i)];
    if (simulated.toughness && is_first(simulated, designs))
      film_specimen(simulated, simulation_of(simulated.design, settings), options);
  });
}

/// One curve a specimen: KEY.csv, of several KEY-0.csv, KEY-1.csv, ...
void write_curves(const std::vector<SimulatedDesign>& designs, const SimulateOptions& options) {
  if (options.curves.empty()) return;
  for (const SimulatedDesign& simulated : designs)
    for (std::size_t i = 0; i < simulated.pulled.size(); ++i) {
      if (!simulated.pulled[i]) continue;
      const std::string number = simulated.pulled.size() > 1 ? fmt::format("-{}", i) : "";
      write_file_atomically(
          std::filesystem::path(options.curves) / (file_stem(simulated.design.name()) + number + ".csv"),
          measurement::to_csv(simulated.pulled[i]->curve));
    }
}

/// Before anything is computed: the specimens that were asked for exist.
void check_specimen_options(const SimulateOptions& options, const SimulateSettings& settings) {
  if (options.choice.refine > 1 && options.wants_films())
    throw InputError("--frames and --film show unrefined elements: leave out --refine");
  if (settings.specimens() > 1 && !tester::specimens_differ(settings.parameters))
    warn(fmt::format("--specimens {}: without --strength-cv they are all alike", settings.specimens()));
  if (settings.specimens() > 1 && options.wants_films()) remark("films show specimen 0, T is the mean over specimens");
}

/// Before anything is computed: a GIF shows one specimen, and the outputs can be written.
void check_output_options(const SimulateOptions& options) {
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

int simulate(const SimulateOptions& options) {
  std::vector<SimulatedDesign> designs = read_designs(options.patterns);
  const auto read = [&](const material::ParameterSet& start) { return parameters_from_option(options.params, start); };
  const SimulateSettings settings{
      .parameters = offline::chosen_model(read, options.model, {"--criterion", "--strength-cv"}),
      .fidelity = fidelity_from_option(options.fidelity),
      .modulus = options.test != "toughness",
      .toughness = options.test != "modulus",
      .choice = options.choice};
  check_specimen_options(options, settings);
  check_output_options(options);
  run_tests(designs, options, settings);
  write_curves(designs, options);
  bool any_succeeded = false;
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const SimulatedDesign& simulated : designs) {
    any_succeeded = any_succeeded || simulated.failure().empty();
    document.push_back(to_json(simulated, settings));
  }
  options.json ? print_json(document) : print_table(designs, settings);
  return any_succeeded ? 0 : 1;
}

}  // namespace

void add_simulate(CLI::App& app, Action& action) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App& command = add_command(app, action, "simulate",
                                  "Simulate the stiffness test and the toughness test of patterns", options, simulate);
  command.add_option("PATTERN", options->patterns, kDesignWords)->required();
  command.add_option("--params", options->params, "Parameter file of the model; default: the built-in parameters");
  command.add_option("--test", options->test, "Which test to simulate")
      ->check(CLI::IsMember({"modulus", "toughness", "both"}))
      ->capture_default_str();
  add_fidelity(command, options->fidelity)->capture_default_str();
  command
      .add_option("--specimens", options->choice.count,
                  "T is the mean over so many specimens of each pattern; default: 8, of a model without variation 1")
      ->check(CLI::Range(1, 1000));
  command.add_option("--strength-cv", options->model.strength_cv,
                     "Variation of failure energy between regions of half a pixel: 0, or 0.02 to 0.4; default: the "
                     "model's");
  command
      .add_option("--criterion", options->model.criterion,
                  "When elements fail in the toughness test; default: the model's")
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
