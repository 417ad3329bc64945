#pragma once
// What the figures and tables of the thesis are made of, read from the files of a run.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "families/grouping.hpp"
#include "game/thesis_tables.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

/// One search for a gamut: what it simulated, in its order.
struct SearchPath {
  int round = 0, branch = 0;
  std::vector<optimize::Performance> samples;
};

/// A point of a subfamily's map (`nacre families`).
struct MapPoint {
  pattern::Pattern pattern;
  std::string source;                          ///< seed, sampled, interpolated
  double x = 0.0, y = 0.0;                     ///< of the map of all
  std::optional<double> x_sampled, y_sampled;  ///< of the map before interpolation
  std::optional<optimize::Performance> performance;
};

struct SubfamilyMap {
  std::string family, seed;
  std::vector<MapPoint> points;
};

/// What models predict for designs, as recorded by the testing machine: round of the model -> design -> values.
using ModelPredictions = std::map<int, std::map<std::string, game::DesignValues>>;

/// What a run does not hold is empty.
struct PaperSource {
  std::string run_id;
  run::RunRecord run;
  game::ThesisTables thesis;
  std::vector<measurement::Replicates> base_materials;  ///< that round 0 was fitted to
  std::vector<SearchPath> searches;                     ///< by round and branch
  ModelPredictions predictions;
  std::vector<families::SeedFamily> groups;
  std::string groups_from;         ///< where they come from, in words
  std::vector<SubfamilyMap> maps;  ///< by family and seed
};

/// Reads a run's folder; `thesis_folder` is data/thesis, empty when it was not found. Throws InputError.
PaperSource read_paper_source(const std::filesystem::path& run_dir, const std::string& run_id,
                              const std::filesystem::path& thesis_folder);

/// Relative error of a prediction, where both are known.
std::optional<double> error_of(const std::optional<double>& simulated, const std::optional<double>& measured);

}  // namespace nacre::report
