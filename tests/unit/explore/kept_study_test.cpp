// Beginnings of the searches of docs/studies/search.md, kept in data/: they are what the study's tables say, and what
// today's program goes on with.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <unordered_map>

#include "base/files.hpp"
#include "explore/batch_log.hpp"
#include "explore/search.hpp"
#include "optimize/pareto.hpp"

namespace nacre::explore {
namespace {

namespace fs = std::filesystem;

const fs::path kKept = fs::path(NACRE_SOURCE_DIR) / "tests/unit/explore/data";
const fs::path kStudy = fs::path(NACRE_SOURCE_DIR) / "docs/studies/search";

using Evaluations = std::unordered_map<std::string, optimize::Performance>;

Evaluations kept_evaluations(const std::string& set) {
  std::ifstream file(kKept / ("evaluations-preview-" + set + "-kernel8.csv"));
  std::string line;
  std::getline(file, line);
  Evaluations evaluations;
  while (std::getline(file, line)) {
    const std::size_t modulus = line.find(',') + 1, toughness = line.find(',', modulus) + 1;
    evaluations[line.substr(0, modulus - 1)] = {std::strtod(&line[modulus], nullptr),
                                                std::strtod(&line[toughness], nullptr)};
  }
  return evaluations;
}

/// Hypervolume in GPa MPa after every batch of a kept search, by samples.
std::map<int, double> growth_of(const std::string& set, int seed) {
  const Evaluations evaluations = kept_evaluations(set);
  std::ifstream file(kKept / ("preview-" + set + "-learned-" + std::to_string(seed) + "-batches.txt"));
  std::string line;
  std::getline(file, line);
  std::map<int, double> growth;
  std::vector<optimize::Performance> found;
  while (std::getline(file, line)) {
    std::istringstream keys(line);
    for (std::string key; keys >> key;) found.push_back(evaluations.at(key));
    growth[static_cast<int>(found.size())] = optimize::hypervolume_staircase_gpa_mpa(found);
  }
  return growth;
}

/// Samples until a hypervolume; 0 where the kept beginning has not come so far.
int samples_until(double goal, const std::map<int, double>& growth) {
  const auto reached = std::ranges::find_if(growth, [goal](const auto& step) { return step.second >= goal; });
  return reached == growth.end() ? 0 : reached->first;
}

/// The cells of the row of a study's table that begins with `begin`, by column.
std::map<std::string, std::string> row_of(const std::string& table, const std::string& begin) {
  std::ifstream file(kStudy / table);
  std::string head, line;
  std::getline(file, head);
  while (std::getline(file, line) && !line.starts_with(begin)) continue;
  std::istringstream names(head), cells(line);
  std::map<std::string, std::string> row;
  for (std::string name, cell; std::getline(names, name, ',');)
    row[name] = std::getline(cells, cell, ',') ? cell : std::string();
  return row;
}

TEST(KeptStudy, SearchesNeedAsManySamplesAsIsSaid) {
  const auto needed = [](const std::string& set, int seed, const std::string& goal) {
    const auto row = row_of("goals.csv", "preview," + set + ",learned," + goal);
    EXPECT_EQ(std::to_string(samples_until(std::stod(row.at("hypervolume_gpa_mpa")), growth_of(set, seed))),
              row.at("seed_" + std::to_string(seed)));
    return row.at("seed_" + std::to_string(seed));
  };
  EXPECT_EQ(needed("default", 1, "mean"), "390");
  EXPECT_EQ(needed("default", 4, "mean"), "190");
  EXPECT_EQ(needed("round4", 3, "mean"), "400");
}

TEST(KeptStudy, TheTableOfHypervolumesIsThatOfTheSamples) {
  for (const auto& [set, seed] : {std::pair("default", 1), {"default", 4}, {"round4", 3}}) {
    const auto growth = growth_of(set, seed);
    const auto row = row_of("hypervolume.csv", fmt::format("preview,{},learned,{},", set, seed));
    for (const int samples : {100, 200})
      EXPECT_EQ(row.at(std::to_string(samples)), fmt::format("{:.4f}", growth.at(samples))) << set;
  }
}

/// Opens a copy of a kept log as the search of these settings; throws where it is another's.
void go_on(const std::string& variant, const SearchSettings& settings) {
  const fs::path copy = fs::path(testing::TempDir()) / "nacre_kept_batches.txt";
  fs::copy_file(kKept / ("preview-default-" + variant + "-1-batches.txt"), copy, fs::copy_options::overwrite_existing);
  BatchLog(copy, settings);
  fs::remove(copy);
}

TEST(KeptStudy, TodaysProgramGoesOnWithKeptSearches) {
  SearchSettings settings;
  settings.algorithm = "learned";
  settings.seed = 1;
  const auto some = [](std::span<const pattern::Pattern>) { return Eigen::MatrixXd(); };
  settings.mechanics.modulus_of = [](std::span<const pattern::Pattern>) {
    return std::vector<std::optional<double>>();
  };
  EXPECT_NO_THROW(go_on("barred", settings));
  settings.mechanics.cell_modulus = some;
  EXPECT_NO_THROW(go_on("cells-modulus", settings));
  settings.mechanics.cell_loads = some;
  EXPECT_NO_THROW(go_on("learned", settings));
  settings.mechanics.cell_modulus = settings.mechanics.cell_loads = {};
  settings.learned.barred_start = settings.learned.barred_candidates = 0;
  EXPECT_NO_THROW(go_on("computed", settings));
  settings.mechanics.modulus_of = {};
  EXPECT_NO_THROW(go_on("believed", settings));
}

}  // namespace
}  // namespace nacre::explore
