// The demonstration game under several seeds: gap, hypervolume and held-out errors of every round, and their medians
// over seeds. A finished game is read, an interrupted one resumed. Results: docs/studies/demo.md.
// base_only.toml, extended.toml and true_model.toml beside this file: what an extension of the model is worth in a
// game, and what it could be worth.

#include <filesystem>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/result.hpp"
#include "base/statistics.hpp"
#include "runtime/launcher.hpp"
#include "runtime/process.hpp"
#include "runtime/round_history.hpp"

namespace {

using namespace nacre;
using Rounds = std::vector<round_summary_t>;

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

struct Column {
  const char* title;
  std::function<double(const round_summary_t&)> value;
  double unit;
};

const std::vector<Column> kColumns = {
    {"gap, GPa MPa", [](const auto& r) { return r.gap; }, 1.0},
    {"measured hypervolume", [](const auto& r) { return r.measured_hypervolume_staircase; }, 1.0},
    {"held-out E, %", [](const auto& r) { return r.held_out.modulus_mean; }, 100.0},
    {"held-out T, %", [](const auto& r) { return r.held_out.toughness_mean; }, 100.0},
    {"fitted E, %", [](const auto& r) { return r.after.modulus_mean; }, 100.0},
    {"fitted T, %", [](const auto& r) { return r.after.toughness_mean; }, 100.0},
};

void print_row(const std::string& head, const std::function<double(const Column&)>& cell) {
  fmt::print("| {} |", head);
  for (const Column& column : kColumns) fmt::print(" {:.4g} |", cell(column));
  fmt::print("\n");
}

void print_table(const std::vector<std::pair<std::uint64_t, Rounds>>& games) {
  fmt::print("| seed, round |");
  for (const Column& column : kColumns) fmt::print(" {} |", column.title);
  fmt::print("\n| --- |");
  for (std::size_t i = 0; i < kColumns.size(); ++i) fmt::print(" --- |");
  fmt::print("\n");
  std::size_t longest = 0;
  for (const auto& [seed, rounds] : games) {
    longest = std::max(longest, rounds.size());
    for (const round_summary_t& round : rounds)
      print_row(fmt::format("{}, {}", seed, round.round), [&](const Column& c) { return c.unit * c.value(round); });
  }
  for (std::size_t i = 0; i < longest; ++i) {
    print_row(fmt::format("median, {}", i), [&](const Column& column) {
      std::vector<double> values;
      for (const auto& [seed, rounds] : games)
        if (i < rounds.size()) values.push_back(column.unit * column.value(rounds[i]));
      return quantile(values, 0.5);
    });
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Plays a scenario under several seeds and sums up its rounds"};
  std::filesystem::path scenario = "launch/demo.toml", logs = "logs";
  std::vector<std::uint64_t> seeds = {1, 2, 3, 4, 5};
  app.add_option("--scenario", scenario, "scenario file")->capture_default_str();
  app.add_option("--logs", logs, "where runs are kept")->capture_default_str();
  app.add_option("--seeds", seeds, "seeds of the games");
  CLI11_PARSE(app, argc, argv);
  std::vector<std::pair<std::uint64_t, Rounds>> games;
  try {
    for (const std::uint64_t seed : seeds) {
      Rounds rounds = play(scenario, logs, seed);
      if (rounds.empty()) return 1;
      games.emplace_back(seed, std::move(rounds));
    }
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  print_table(games);
}
