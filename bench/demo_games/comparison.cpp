#include "comparison.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/statistics.hpp"
#include "report/standalone.hpp"
#include "report/svg.hpp"

namespace nacre::demo_games {
namespace {

constexpr int kFirstDrawn = 2;

struct Column {
  const char* title;
  const char* file;
  std::function<double(const wire::RoundSummary&)> value;
  double unit;
};

const std::vector<Column> kColumns = {
    {"gap, GPa MPa", "gap", [](const auto& r) { return r.gap; }, 1.0},
    {"measured hypervolume", "measured-hypervolume", [](const auto& r) { return r.measured_hypervolume_staircase; },
     1.0},
    {"prediction error of E, %", "held-out-modulus", [](const auto& r) { return r.held_out.modulus_mean; }, 100.0},
    {"prediction error of T, %", "held-out-toughness", [](const auto& r) { return r.held_out.toughness_mean; }, 100.0},
    {"fitted E, %", "fitted-modulus", [](const auto& r) { return r.after.modulus_mean; }, 100.0},
    {"fitted T, %", "fitted-toughness", [](const auto& r) { return r.after.toughness_mean; }, 100.0},
};

void print_row(const std::string& head, const std::function<double(const Column&)>& cell) {
  fmt::print("| {} |", head);
  for (const Column& column : kColumns) fmt::print(" {:.4g} |", cell(column));
  fmt::print("\n");
}

/// Median over seeds of one column in one round; nothing when no game got there.
std::optional<double> median(const Games& games, const Column& column, std::size_t round) {
  std::vector<double> values;
  for (const auto& [seed, rounds] : games.by_seed)
    if (round < rounds.size()) values.push_back(column.unit * column.value(rounds[round]));
  return values.empty() ? std::nullopt : std::optional(quantile(values, 0.5));
}

std::size_t longest(const Games& games) {
  std::size_t rounds = 0;
  for (const auto& [seed, of_game] : games.by_seed) rounds = std::max(rounds, of_game.size());
  return rounds;
}

std::string figure(const std::vector<Games>& scenarios, const Column& column) {
  constexpr report::Ink kInks[] = {report::Ink::measured, report::Ink::simulated, report::Ink::homogeneous};
  std::vector<double> all;
  double last = kFirstDrawn;
  std::vector<std::vector<report::PlotPoint>> lines, games;
  for (const Games& scenario : scenarios) {
    lines.emplace_back();
    games.emplace_back();
    for (std::size_t round = kFirstDrawn; round < longest(scenario); ++round) {
      const double x = static_cast<double>(round);
      last = std::max(last, x);
      lines.back().push_back({x, *median(scenario, column, round)});
      for (const auto& [seed, rounds] : scenario.by_seed)
        if (round < rounds.size()) games.back().push_back({x, column.unit * column.value(rounds[round])});
    }
    for (const report::PlotPoint& point : games.back()) all.push_back(point.y);
  }
  report::Plot plot({.title = column.title,
                     .x_label = "round",
                     .y_label = column.title,
                     .x = {kFirstDrawn - 0.2, last + 0.2},
                     .y = report::range_with_zero(all),
                     .whole_numbers_x = true});
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const report::Ink ink = kInks[i % std::size(kInks)];
    plot.line(lines[i], ink, report::Stroke::solid, scenarios[i].scenario);
    plot.dots(games[i], ink, "");
  }
  return report::standalone(plot.svg());
}

}  // namespace

void print_table(const Games& games) {
  fmt::print("| seed, round |");
  for (const Column& column : kColumns) fmt::print(" {} |", column.title);
  fmt::print("\n| --- |");
  for (std::size_t i = 0; i < kColumns.size(); ++i) fmt::print(" --- |");
  fmt::print("\n");
  for (const auto& [seed, rounds] : games.by_seed) {
    for (const wire::RoundSummary& round : rounds)
      print_row(fmt::format("{}, {}", seed, round.round), [&](const Column& c) { return c.unit * c.value(round); });
  }
  for (std::size_t round = 0; round < longest(games); ++round) {
    print_row(fmt::format("median, {}", round), [&](const Column& column) { return *median(games, column, round); });
  }
}

void draw_figures(const std::vector<Games>& scenarios, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const Column& column : kColumns) {
    write_file_atomically(folder / fmt::format("{}.svg", column.file), figure(scenarios, column));
  }
}

}  // namespace nacre::demo_games
