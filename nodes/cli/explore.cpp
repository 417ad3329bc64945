// Part of the command line (command.hpp): nacre explore, the search for the gamut in this process.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "base/counted.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "explore/batch_log.hpp"
#include "explore/gamut_csv.hpp"
#include "explore/mechanics.hpp"
#include "explore/search.hpp"
#include "material/parameter_file.hpp"
#include "material/parameters.hpp"
#include "output.hpp"
#include "output_path.hpp"
#include "progress.hpp"
#include "runtime/interrupts.hpp"
#include "store/kept_simulation.hpp"

namespace nacre::cli {
namespace {

struct Options {
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
  bool json = false;
};

void print_summary(const std::vector<explore::Evaluated>& gamut, const Options& options, int failed) {
  const std::vector<optimize::Performance> points = explore::performances_of(gamut);
  const double hypervolume = optimize::hypervolume_staircase_gpa_mpa(points);
  const std::size_t front_size = optimize::pareto_front(points).size();
  if (options.json) {
    print_json({{"evaluated", gamut.size()},
                {"failed", failed},
                {"front", front_size},
                {"hypervolume_gpa_mpa", hypervolume},
                {"gamut", options.out}});
  } else {
    fmt::print("{} simulated ({} failed), {} of them on the Pareto front, hypervolume {:.4f} GPa MPa; written to {}\n",
               counted(static_cast<std::int64_t>(gamut.size()), "pattern"), failed, front_size, hypervolume,
               options.out);
  }
}

explore::SearchSettings search_settings(const Options& options) {
  explore::SearchSettings settings;
  settings.algorithm = options.algorithm;
  settings.budget = options.budget;
  settings.population = options.population;
  settings.batch = options.batch;
  settings.seed = options.seed;
  if (!options.former.empty() && options.algorithm != "learned")
    throw InputError::format("--former: `{}` cannot learn from former samples, expected --algorithm learned",
                             options.algorithm);
  if (!options.known.empty()) settings.known = explore::read_gamut_csv(options.known);
  if (options.former.empty()) return settings;
  settings.former = explore::read_gamut_csv(options.former);
  if (settings.former.empty())
    throw InputError::format("{}: holds no samples, expected some to learn from", options.former);
  return settings;
}

int explore_gamut(const Options& options) {
  const tester::Fidelity fidelity = fidelity_from_option(options.fidelity);
  const auto parameters = parameters_from_option(options.params, material::default_parameters());
  explore::SearchSettings settings = search_settings(options);
  settings.mechanics = explore::mechanics_by_tester(parameters, fidelity, 0);
  const auto search = explore::make_search(settings);
  const int unlearnt = settings.population + (settings.former.empty() ? settings.learned.barred_start : 0);
  if (settings.algorithm == "learned" && settings.budget <= unlearnt)
    remark(fmt::format("--budget {}: too small for `learned`, which begins to learn after {} patterns", settings.budget,
                       unlearnt));
  prepare_output_file(options.out, {options.cache, options.params, options.former});
  std::unique_ptr<store::SimulationCache> cache;
  std::optional<explore::BatchLog> log;
  if (!options.cache.empty()) {
    cache = std::make_unique<store::SimulationCache>(options.cache);
    log.emplace(options.out + ".batches", settings, content_hash(options.fidelity + material::to_toml(parameters)));
  }
  const auto ask = [&] { return log ? log->ask(*search) : search->ask(); };
  const runtime::Interrupts interrupts;
  Progress progress("explore: patterns", options.budget);
  constexpr auto kSaveEvery = std::chrono::seconds(5);
  auto saved = std::chrono::steady_clock::now();
  int failed = 0;
  for (auto batch = ask(); !batch.empty(); batch = ask()) {
    std::vector<std::optional<optimize::Performance>> performances(batch.size());
    parallel_for(static_cast<int>(batch.size()), [&](int i) {
      const auto index = static_cast<std::size_t>(i);
      if (interrupts.any()) return;
      performances[index] = store::kept_performance({batch[index], parameters, {}, fidelity}, cache.get());
      progress.advance();
    });
    if (interrupts.any()) break;  // what is missing of this batch was not simulated: it must not count as failed
    for (const auto& performance : performances) failed += performance ? 0 : 1;
    search->tell(performances);
    if (std::chrono::steady_clock::now() - saved < kSaveEvery) continue;
    explore::write_gamut_csv(options.out, search->evaluated());
    saved = std::chrono::steady_clock::now();
  }
  if (interrupts.any() && search->evaluated().size() == settings.known.size()) {
    remark(fmt::format("stopped before a pattern was simulated; {} is unchanged", options.out));
    return 1;
  }
  explore::write_gamut_csv(options.out, search->evaluated());
  if (interrupts.any()) remark("stopped; the patterns simulated so far are kept");
  print_summary(search->evaluated(), options, failed);
  return interrupts.any() || search->evaluated().empty() ? 1 : 0;
}

}  // namespace

void add_explore(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = add_command(app, action, "explore", "Search for patterns that are stiff and tough, by simulation",
                                  options, explore_gamut);
  command.add_option("--params", options->params, "Parameter file; default: the built-in parameters");
  command
      .add_option("--algorithm", options->algorithm,
                  fmt::format("How to search: {}", fmt::join(explore::algorithms(), ", ")))
      ->capture_default_str();
  command.add_option("--budget", options->budget, "How many patterns to simulate")
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
  add_seed(command, options->seed, "Seed of every random choice")->capture_default_str();
  command.add_option("--population", options->population, "Patterns of a generation, or of the first batch")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  command.add_option("--batch", options->batch, "Patterns simulated at once, between two steps of the search")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
