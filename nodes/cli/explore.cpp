// Part of the command line (command.hpp): nacre explore, the search for the gamut in this process.

#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "base/counted.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "explore/gamut_csv.hpp"
#include "explore/search.hpp"
#include "material/parameters.hpp"
#include "offline/ask_tell.hpp"
#include "offline/explore.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "runtime/interrupts.hpp"

namespace nacre::cli {
namespace {

struct ExploreOptions {
  std::string params;
  std::string algorithm = "nsga2";
  int budget = 300;
  std::string out;
  std::string cache;
  std::string known;
  std::string former;
  std::string fidelity = "full";
  std::uint64_t seed = 1;
  int population = 20;
  int batch = 10;
  int specimens = 1;
  bool json = false;
  bool ask_tell = false;
};

void print_summary(const offline::Explored& explored, const ExploreOptions& options) {
  const nlohmann::ordered_json document = offline::to_json(explored, options.out);
  if (options.json) return print_json(document);
  fmt::print("{} simulated ({} failed), {} of them on the Pareto front, hypervolume {:.4f} GPa MPa; written to {}\n",
             counted(explored.gamut.size(), "pattern"), explored.failed, document["front"].get<int>(),
             document["hypervolume_gpa_mpa"].get<double>(), options.out);
}

explore::SearchSettings search_settings(const ExploreOptions& options) {
  explore::SearchSettings settings;
  settings.algorithm = options.algorithm;
  settings.budget = options.budget;
  settings.population = options.population;
  settings.batch = options.batch;
  settings.seed = options.seed;
  settings.learned.specimens = options.specimens;
  if (!options.known.empty()) settings.known = explore::read_gamut_csv(options.known);
  if (options.former.empty()) return settings;
  settings.former = explore::read_gamut_csv(options.former);
  if (settings.former.empty())
    throw InputError::format("{}: holds no samples, expected some to learn from", options.former);
  return settings;
}

offline::ExploreSettings settings_from(const ExploreOptions& options) {
  offline::ExploreSettings settings;
  settings.fidelity = fidelity_from_option(options.fidelity);
  settings.parameters = parameters_from_option(options.params, material::default_parameters());
  settings.search = search_settings(options);
  if (const std::string fault = offline::search_fault(settings); !fault.empty()) throw InputError("--" + fault);
  settings.cache = options.cache;
  if (!options.cache.empty() || options.ask_tell) settings.batches = options.out + ".batches";
  const explore::SearchSettings& search = settings.search;
  const int unlearnt = search.population + (search.former.empty() ? search.learned.barred_start : 0);
  if (search.algorithm == "learned" && search.budget <= unlearnt)
    remark(fmt::format("--budget {}: too small for `learned`, which begins to learn after {} patterns", search.budget,
                       unlearnt));
  return settings;
}

/// Writes the gamut now and then, so that little is lost where the program is killed.
class SavedGamut {
 public:
  explicit SavedGamut(std::string file) : file_(std::move(file)) {}
  void keep(const std::vector<explore::Evaluated>& gamut) {
    constexpr auto kSaveEvery = std::chrono::seconds(5);
    if (std::chrono::steady_clock::now() - saved_ < kSaveEvery) return;
    explore::write_gamut_csv(file_, gamut);
    saved_ = std::chrono::steady_clock::now();
  }

 private:
  std::string file_;
  std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

/// Requests line by line until they end or the program is interrupted; the log beside the gamut is what it goes on by.
int converse(const ExploreOptions& options) {
  const offline::ExploreSettings settings = settings_from(options);
  explore::make_search(settings.search);
  prepare_output_file(options.out, {options.cache, options.params, options.former});
  const runtime::Interrupts interrupts;
  offline::AskTell conversation(settings, options.out + ".log", [&] { return interrupts.any(); });
  SavedGamut saved(options.out);
  bool is_understood = true;
  const auto say = [](const nlohmann::ordered_json& response) {
    std::cout << response.dump() << std::endl;
    check_standard_output();
  };
  say(conversation.standing());
  std::string line;
  for (std::size_t number = 1; !interrupts.any() && std::getline(std::cin, line); ++number) {
    const nlohmann::ordered_json response = conversation.respond(line, number);
    if (interrupts.any()) break;  // what was tested of the request stands in the log
    is_understood = is_understood && !response.contains("error");
    say(response);
    saved.keep(conversation.gamut());
  }
  explore::write_gamut_csv(options.out, conversation.gamut());
  if (interrupts.any()) return 1;
  return is_understood ? 0 : kBadInput;
}

int explore_gamut(const ExploreOptions& options) {
  if (options.ask_tell) return converse(options);
  const offline::ExploreSettings settings = settings_from(options);
  explore::make_search(settings.search);  // bad settings are refused before a folder is made
  prepare_output_file(options.out, {options.cache, options.params, options.former});
  const runtime::Interrupts interrupts;
  Progress progress("explore: patterns", options.budget);
  SavedGamut saved(options.out);
  const offline::Explored explored =
      offline::explore_gamut(settings, {.simulated = [&] { progress.advance(); },
                                        .stopped = [&] { return interrupts.any(); },
                                        .told = [&](const auto& gamut) { saved.keep(gamut); }});
  if (interrupts.any() && explored.gamut.size() == settings.search.known.size()) {
    remark(fmt::format("stopped before a pattern was simulated; {} is unchanged", options.out));
    return 1;
  }
  explore::write_gamut_csv(options.out, explored.gamut);
  if (interrupts.any()) remark("stopped; the patterns simulated so far are kept");
  print_summary(explored, options);
  return interrupts.any() || explored.gamut.empty() ? 1 : 0;
}

}  // namespace

void add_explore(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExploreOptions>();
  CLI::App& command = add_command(app, action, "explore", "Search for patterns that are stiff and tough, by simulation",
                                  options, explore_gamut);
  command.add_option("--params", options->params, "Parameter file; default: the built-in parameters");
  command
      .add_option("--algorithm", options->algorithm,
                  fmt::format("How to search: {}", fmt::join(explore::algorithms(), ", ")))
      ->capture_default_str();
  command.add_option("--budget", options->budget, "How many fracture tests")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command.add_option("--out", options->out, "gamut.csv to write: every simulated pattern with E and T")->required();
  command.add_option("--cache", options->cache,
                     "Database that keeps the simulations, so that an interrupted search goes on where it was");
  command.add_option("--known", options->known,
                     "gamut.csv of the same parameters and fidelity: its patterns are not simulated again");
  command.add_option("--former", options->former,
                     "gamut.csv of other parameters or another fidelity, from which `learned` learns");
  add_fidelity(command, options->fidelity)->capture_default_str();
  CLI::Option* specimens = command.add_option(
      "--specimens", options->specimens,
      "Specimens of a pattern that `learned` may test, further ones where they decide: T is then an expectation");
  specimens->check(CLI::Range(1, 100))->capture_default_str();
  add_seed(command, options->seed, "Seed of every random choice")->capture_default_str();
  command.add_option("--population", options->population, "Patterns of a generation, or of the first batch")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  command.add_option("--batch", options->batch, "Patterns simulated at once, between two steps of the search")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  CLI::Option* json = command.add_flag("--json", options->json, "One JSON document on standard output");
  command
      .add_flag(
          "--ask-tell", options->ask_tell,
          "Requests as JSON lines on standard input, responses on standard output: ask for a batch, tell E, T and "
          "standard errors, test patterns (docs/FORMATS.md). The same command again goes on where it was")
      ->excludes(json)
      ->excludes(specimens);
}

}  // namespace nacre::cli
