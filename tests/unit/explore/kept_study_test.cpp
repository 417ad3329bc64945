// The searches kept in bench/search_study are those that docs/studies/search.md speaks of, and those that today's
// program goes on with.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "base/files.hpp"
#include "explore/batch_log.hpp"
#include "explore/search.hpp"
#include "optimize/pareto.hpp"

namespace nacre::explore {
namespace {

namespace fs = std::filesystem;

const fs::path kKept = fs::path(NACRE_SOURCE_DIR) / "bench/search_study";

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

/// Samples that a kept search needed for a hypervolume in GPa MPa; 0 where it has not come so far.
int samples_until(double goal, const std::string& set, int seed, const Evaluations& evaluations) {
  std::ifstream file(kKept / ("preview-" + set + "-learned-" + std::to_string(seed) + "-batches.txt"));
  std::string line;
  std::getline(file, line);
  std::vector<optimize::Performance> found;
  while (std::getline(file, line)) {
    std::istringstream keys(line);
    for (std::string key; keys >> key;) found.push_back(evaluations.at(key));
    if (optimize::hypervolume_staircase_gpa_mpa(found) >= goal) return static_cast<int>(found.size());
  }
  return 0;
}

TEST(KeptStudy, SearchesNeedAsManySamplesAsIsSaid) {
  const auto samples = [](double goal, const std::string& set, int seeds) {
    const Evaluations evaluations = kept_evaluations(set);
    std::vector<int> needed;
    for (int seed = 1; seed <= seeds; ++seed) needed.push_back(samples_until(goal, set, seed, evaluations));
    return needed;
  };
  EXPECT_THAT(samples(0.6826, "default", 6), testing::ElementsAre(390, 2140, 860, 190, 210, 520));
  EXPECT_THAT(samples(0.8109, "round4", 3), testing::ElementsAre(470, 680, 400));
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
