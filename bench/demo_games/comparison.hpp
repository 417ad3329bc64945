#pragma once
// Games of several seeds and scenarios beside each other: tables and figures.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "wire/convert.hpp"

namespace nacre::demo_games {

using Rounds = std::vector<wire::RoundSummary>;

/// The games of one scenario.
struct Games {
  std::string scenario;
  std::vector<std::pair<std::uint64_t, Rounds>> by_seed;
};

/// Every round of every seed, and the medians over seeds, as a Markdown table on standard output.
void print_table(const Games& games);

/// One SVG file per figure of print_table() in `folder`: the median over seeds by round, a line per scenario, and a dot
/// per game. From the second round on: the predictions of round 1 know no microstructure. At most three scenarios are
/// told apart by their colours.
void draw_figures(const std::vector<Games>& scenarios, const std::filesystem::path& folder);

}  // namespace nacre::demo_games
