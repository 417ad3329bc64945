// Games under several seeds: gap, hypervolume and out-of-sample prediction errors of every round, and their medians
// over seeds. A finished game is read, an interrupted one resumed. Several scenarios are drawn beside each other.
// Results: docs/studies/demo.md and extended-games.md. The folders beside this file, by what the laboratory hides:
// what an extension of the model is worth in a game (extended, base_only), and what it could be worth (true_model).

#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/result.hpp"
#include "comparison.hpp"
#include "runtime/launcher.hpp"
#include "runtime/process.hpp"
#include "runtime/round_history.hpp"

namespace {

using namespace nacre;
using namespace nacre::demo_games;

/// Plays, or goes on with, the game of one seed. Empty when it was stopped before its end.
Rounds play(const std::filesystem::path& scenario, const std::filesystem::path& logs, std::uint64_t seed) {
  const std::string name = fmt::format("{}-seed-{}", scenario.stem().string(), seed);
  const std::filesystem::path folder = logs / name;
  if (std::filesystem::exists(folder)) {
    Rounds rounds = runtime::read_rounds(folder);
    if (!rounds.empty() && rounds.back().last) return rounds;
  }
  runtime::LaunchOptions options;
  options.logs = logs;
  options.nacre = runtime::this_program().parent_path() / "nacre";
  if (std::filesystem::exists(folder)) {
    options.resume = folder;
  } else {
    options.scenario = scenario;
    options.run_name = name;
    options.seed = seed;
  }
  if (runtime::launch(options) != 0) return {};
  return runtime::read_rounds(folder);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Plays scenarios under several seeds and sums up their rounds"};
  std::vector<std::filesystem::path> scenarios = {"launch/demo.toml"};
  std::filesystem::path logs = "logs", figures;
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5};
  app.add_option("--scenario", scenarios, "scenario files")->capture_default_str();
  app.add_option("--logs", logs, "where runs are kept")->capture_default_str();
  app.add_option("--seeds", seeds, "seeds of the games");
  app.add_option("--figures", figures, "folder for the scenarios beside each other, by round, as SVG");
  CLI11_PARSE(app, argc, argv);
  std::vector<Games> all;
  try {
    for (const std::filesystem::path& scenario : scenarios) {
      Games games{.scenario = scenario.stem().string(), .by_seed = {}};
      for (const std::uint64_t seed : seeds) {
        Rounds rounds = play(scenario, logs, seed);
        if (rounds.empty()) return 1;
        games.by_seed.emplace_back(seed, std::move(rounds));
      }
      fmt::print("{}{}\n\n", all.empty() ? "" : "\n", games.scenario);
      print_table(games);
      all.push_back(std::move(games));
    }
    if (!figures.empty()) draw_figures(all, figures);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
