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
#include "crack/crack_record.hpp"
#include "crack/mechanisms.hpp"
#include "film/film_file.hpp"
#include "film_files.hpp"
#include "material/parameters.hpp"
#include "measurement/set_files.hpp"
#include "output.hpp"
#include "output_path.hpp"
#include "pattern/constraints.hpp"
#include "pattern/design.hpp"
#include "progress.hpp"
#include "tester/modulus.hpp"

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
  bool json = false;

  bool wants_films() const { return !frames.empty() || !film.empty(); }
};

/// A design and the results of its tests.
struct SimulatedSpecimen {
  std::string argument;
  pattern::Design design;
  std::optional<Result<tester::ModulusResult>> modulus;
  std::optional<Result<tester::ToughnessResult>> toughness;
  std::optional<crack::CrackRecord> crack;
  crack::Mechanisms mechanisms;
  double kernel_s = 0.0;  ///< processor time of the toughness test

  /// Why there is no number; empty when every test that was run succeeded.
  std::string failure() const {
    if (modulus && !*modulus) return "modulus: " + modulus->error().message;
    if (toughness && !*toughness) return "toughness: " + toughness->error().message;
    return "";
  }
};

std::vector<SimulatedSpecimen> read_specimens(const std::vector<std::string>& arguments) {
  std::vector<SimulatedSpecimen> specimens;
  for (const std::string& argument : arguments) {
    SimulatedSpecimen& specimen = specimens.emplace_back();
    specimen.argument = argument;
    specimen.design = pattern::design_from_argument(argument);
    const pattern::Layout* layout = specimen.design.layout();
    if (layout == nullptr) continue;
    const auto symmetric = pattern::Pattern::from_layout(*layout);
    const auto violation =
        symmetric ? pattern::violation(*symmetric) : "it lacks the eightfold symmetry of nacre's proposals";
    if (violation) warn(fmt::format("{}: {}; it is simulated all the same", argument, *violation));
  }
  return specimens;
}

/// Pulls the specimen once more for its film, and writes what was asked for.
void film_specimen(const SimulatedSpecimen& specimen, const tester::Simulation& simulation, const Options& options) {
  const Result<film::Film> film = film::record_film(simulation, **specimen.toughness, options.frame_count);
  const std::string stem = file_stem(specimen.design.name());
  if (!film) throw InputError::format("{}: no film: {}", specimen.argument, film.error().message);
  if (!options.frames.empty()) film::write_film(std::filesystem::path(options.frames) / (stem + ".film"), *film);
  if (!options.film.empty()) draw_film(*film, options.film, stem, options.film_width);
}

/// Whether no specimen before it has the same design: files are named after designs, and written once.
bool is_first_of_its_design(const SimulatedSpecimen& specimen, const std::vector<SimulatedSpecimen>& specimens) {
  return &*std::ranges::find(specimens, specimen.design, &SimulatedSpecimen::design) == &specimen;
}

void run_tests(std::vector<SimulatedSpecimen>& specimens, const Options& options,
               const material::ParameterSet& parameters) {
  struct SpecimenTest {
    SimulatedSpecimen* specimen;
    tester::TestKind test;
  };
  std::vector<SpecimenTest> tasks;  // the long tests first
  for (const auto test : {tester::TestKind::toughness, tester::TestKind::modulus}) {
    if (options.test != "both" && options.test != tester::to_string(test)) continue;
    for (SimulatedSpecimen& specimen : specimens) tasks.push_back({&specimen, test});
  }
  const tester::Fidelity fidelity = fidelity_from_option(options.fidelity);
  Progress progress("simulate: tests", static_cast<std::int64_t>(tasks.size()));
  parallel_for(static_cast<int>(tasks.size()), [&](int i) {
    const SpecimenTest& task = tasks[i];
    SimulatedSpecimen& specimen = *task.specimen;
    const tester::Simulation simulation{specimen.design, parameters, {}, fidelity};
    if (task.test == tester::TestKind::modulus) {
      specimen.modulus = tester::test_modulus(simulation);
    } else {
      const double begun_s = processor_time_s();
      specimen.toughness = tester::test_toughness(simulation);
      specimen.kernel_s = processor_time_s() - begun_s;
      if (*specimen.toughness) {
        specimen.crack = crack::record_of(simulation, (*specimen.toughness)->breaks);
        specimen.mechanisms = crack::mechanisms_of(simulation, *specimen.crack);
        if (options.wants_films() && is_first_of_its_design(specimen, specimens))
          film_specimen(specimen, simulation, options);
      }
    }
    progress.advance();
  });
}

nlohmann::ordered_json to_json(const crack::CrackRecord& crack, const crack::Mechanisms& mechanisms) {
  nlohmann::ordered_json entry = {{"columns", crack.columns},
                                  {"rows", crack.rows},
                                  {"broken", crack.order.size()},
                                  {"branches", crack.branches},
                                  {"separate_cracks", crack.separate_cracks}};
  entry["path_ratio"] = nullptr;
  if (crack.path) {
    entry["path_ratio"] = crack.path->ratio();
    entry["path_length_m"] = crack.path->length_m;
    entry["straight_length_m"] = crack.path->straight_length_m;
    entry["bridged_share"] = crack.path->bridged_share;
    entry["soft_share"] = crack.path->material[0];
    entry["rigid_share"] = crack.path->material[1];
    entry["interface_share"] = crack.path->material[2];
    entry["crosses"] = crack.path->crosses;
    entry["path"] = crack.path->elements;
  }
  const auto names = crack::mechanism_names();
  const auto values = crack::values_of(mechanisms);
  for (std::size_t k = 0; k < names.size(); ++k) entry["mechanisms"][std::string(names[k].name)] = values[k];
  entry["order"] = nlohmann::ordered_json::array();
  for (const tester::Break& broken : crack.order) entry["order"].push_back(broken.element);
  return entry;
}

nlohmann::ordered_json to_json(const SimulatedSpecimen& specimen) {
  nlohmann::ordered_json entry = {{"pattern", specimen.argument}, {"key", specimen.design.name()}};
  if (const std::string failure = specimen.failure(); !failure.empty()) {
    entry["error"] = failure;
    return entry;
  }
  for (const char* field :
       {"modulus_pa", "toughness_pa", "peak_stress_pa", "failure_strain", "end", "steps", "element_steps_per_s"}) {
    entry[field] = nullptr;
  }
  if (specimen.modulus) entry["modulus_pa"] = (*specimen.modulus)->modulus_pa;
  if (specimen.toughness) {
    const tester::ToughnessResult& result = **specimen.toughness;
    entry["toughness_pa"] = result.toughness_pa;
    entry["peak_stress_pa"] = result.peak_stress_pa;
    entry["failure_strain"] = result.failure_strain;
    entry["end"] = tester::to_string(result.end);
    entry["steps"] = result.steps;
    entry["element_steps_per_s"] =
        static_cast<double>(result.steps) * static_cast<double>(result.element_count) / specimen.kernel_s;
  }
  entry["crack"] = specimen.crack ? to_json(*specimen.crack, specimen.mechanisms) : nlohmann::ordered_json(nullptr);
  return entry;
}

std::string_view in_words(tester::EndReason reason) {
  switch (reason) {
    case tester::EndReason::stress_drop:
      return "the specimen separated";
    case tester::EndReason::strain_limit:
      return "unbroken at the largest strain";
    case tester::EndReason::no_failure:
      return "the soft material did not break";
    case tester::EndReason::step_limit:
      return "unbroken at the last step";
  }
  return "";
}

void print_table(const std::vector<SimulatedSpecimen>& specimens) {
  fmt::print("{:<24} {:>10} {:>10} {:>10} {:>14}  {}\n", "pattern", "E / GPa", "T / MPa", "peak / MPa",
             "failure strain", "how the test ended");
  for (const SimulatedSpecimen& specimen : specimens) {
    const std::string name = specimen.argument.size() <= 24 ? specimen.argument : specimen.design.name().substr(0, 24);
    if (const std::string failure = specimen.failure(); !failure.empty()) {
      fmt::print("{:<24} {}\n", name, failure);
      continue;
    }
    fmt::print("{:<24} {:>10}", name, specimen.modulus ? shown(1e-9 * (*specimen.modulus)->modulus_pa) : "");
    if (specimen.toughness) {
      const tester::ToughnessResult& result = **specimen.toughness;
      fmt::print(" {:>10} {:>10.3f} {:>14.4f}  {} after {} steps", shown(1e-6 * result.toughness_pa),
                 1e-6 * result.peak_stress_pa, result.failure_strain, in_words(result.end), result.steps);
    }
    fmt::print("\n");
  }
}

void write_files(const std::vector<SimulatedSpecimen>& specimens, const Options& options) {
  for (const SimulatedSpecimen& specimen : specimens) {
    if (!specimen.toughness || !*specimen.toughness) continue;
    const std::string stem = file_stem(specimen.design.name());
    if (!options.curves.empty()) {
      write_file_atomically(std::filesystem::path(options.curves) / (stem + ".csv"),
                            measurement::to_csv((*specimen.toughness)->curve));
    }
  }
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

int simulate(const Options& options) {
  std::vector<SimulatedSpecimen> specimens = read_specimens(options.patterns);
  const material::ParameterSet parameters = parameters_from_option(options.params, material::default_parameters());
  check_output_options(options);
  run_tests(specimens, options, parameters);
  write_files(specimens, options);
  bool any_succeeded = false;
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const SimulatedSpecimen& specimen : specimens) {
    any_succeeded = any_succeeded || specimen.failure().empty();
    document.push_back(to_json(specimen));
  }
  options.json ? print_json(document) : print_table(specimens);
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
  command.add_option("--curves", options->curves, "Folder for the stress-strain curves, one KEY.csv each");
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
