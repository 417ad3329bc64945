#pragma once
// Maps of patterns in the plane, for the explorer: those that `nacre families` wrote, and those of a gamut's best
// patterns, made here.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "dashboard/families_view.hpp"
#include "dashboard/json_parts.hpp"
#include "families/delaunay.hpp"
#include "pattern/layout.hpp"

namespace nacre::dashboard {

/// A map shows at most so many patterns of a gamut: their distances take some seconds.
inline constexpr std::size_t kMostMapped = 400;

/// One map: columns of equal length; NaN where a pattern was not simulated.
struct PatternMap {
  std::string id;
  std::vector<pattern::Pattern> patterns;
  std::vector<std::string> source;  ///< `seed`, `sampled`, `interpolated`, `gamut`
  Eigen::MatrixX2d points;
  std::vector<double> modulus_pa, toughness_pa;
  double residual_variance = -1.0;  ///< of the Isomap; -1: unknown
};

/// Columns, and the triangles between which one interpolates.
Json to_json(const PatternMap& map);

/// The map of a gamut's best patterns by earth mover's distance and Isomap. The error says why there is none.
Result<PatternMap> map_of_gamut(const run::Gamut& gamut, int round, const std::function<void(double)>& progress);

/// The folder that `nacre families` writes.
class FamilyFolder {
 public:
  explicit FamilyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// families.json, with the ids of the maps that are there; an empty list without it.
  Json families() const;
  /// The map `FAMILY/SEED`. The error says what is wrong with the id or the file.
  Result<PatternMap> map(const std::string& id) const;
  /// families.toml where it can be read, else a proposal; of designs up to `rank`.
  Grouping grouping(std::span<const families::MeasuredPattern> measured, int rank) const;
  const std::filesystem::path& path() const { return folder_; }
  /// The family's own model.
  Result<material::ParameterSet> model(const std::string& family) const;

 private:
  std::filesystem::path folder_;
};

/// The pattern between up to three others, from keys and weights separated by commas: its key, and the constraint that
/// it violates.
Result<Json> between(std::string_view patterns, std::string_view weights);

}  // namespace nacre::dashboard
