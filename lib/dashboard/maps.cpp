#include "dashboard/maps.hpp"

#include <cmath>
#include <limits>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "dashboard/gamut_view.hpp"
#include "families/barycentre.hpp"
#include "families/families_file.hpp"
#include "families/isomap.hpp"
#include "material/parameter_file.hpp"
#include "pattern/constraints.hpp"
#include "pattern/design.hpp"
#include "pattern/pattern_key.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kMostFileBytes = 16u << 20;
constexpr std::size_t kMostRows = 20'000;
constexpr int kNeighbours = 10;
constexpr std::size_t kFewestMapped = 4;

/// Where the columns of a map's file stand.
struct Columns {
  std::size_t pattern = 0, source = 0, x = 0, y = 0, modulus = 0, toughness = 0;
};

Result<Columns> columns_of(const CsvRow& heading, const std::string& file) {
  Columns columns;
  const std::pair<const char*, std::size_t*> wanted[] = {
      {"pattern", &columns.pattern},    {"source", &columns.source},         {"x", &columns.x}, {"y", &columns.y},
      {"modulus_pa", &columns.modulus}, {"toughness_pa", &columns.toughness}};
  for (const auto& [name, place] : wanted) {
    std::size_t found = 0;
    while (found < heading.cells.size() && heading.cells[found].text != name) ++found;
    if (found == heading.cells.size()) return fail("{}:1: column `{}` is missing", file, name);
    *place = found;
  }
  return columns;
}

Result<PatternMap> map_from_csv(std::string_view text, const std::string& file) {
  CsvReader reader(text, file, {.rows = kMostRows + 1});
  CsvRow row;
  if (!reader.next(row)) return fail("{}: is empty", file);
  const auto columns = columns_of(row, file);
  if (!columns) return tl::unexpected(columns.error());
  PatternMap map;
  std::vector<std::pair<double, double>> places;
  while (reader.next(row)) {
    if (row.blank()) continue;
    const auto cell = [&](std::size_t i) {
      return i < row.cells.size() ? std::string(row.cells[i].text) : std::string();
    };
    const auto number = [&](std::size_t i) {
      return number_from_text(cell(i)).value_or(std::numeric_limits<double>::quiet_NaN());
    };
    const auto pattern = pattern::pattern_from_key(cell(columns->pattern));
    const double x = number(columns->x), y = number(columns->y);
    if (!row.fault.empty() || !pattern || !std::isfinite(x) || !std::isfinite(y))
      return fail("{}:{}: expected pattern, x and y", file, row.line);
    map.patterns.push_back(*pattern);
    map.source.push_back(cell(columns->source));
    map.modulus_pa.push_back(number(columns->modulus));
    map.toughness_pa.push_back(number(columns->toughness));
    places.emplace_back(x, y);
  }
  map.points.resize(static_cast<Eigen::Index>(places.size()), 2);
  for (std::size_t i = 0; i < places.size(); ++i)
    map.points.row(static_cast<Eigen::Index>(i)) << places[i].first, places[i].second;
  return map;
}

std::vector<std::string_view> parts(std::string_view list) {
  std::vector<std::string_view> all;
  while (true) {
    const std::size_t comma = list.find(',');
    all.push_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return all;
    list.remove_prefix(comma + 1);
  }
}

}  // namespace

Json to_json(const PatternMap& map) {
  Json patterns = Json::array(), x = Json::array(), y = Json::array(), modulus = Json::array(),
       toughness = Json::array(), triangles = Json::array();
  for (std::size_t i = 0; i < map.patterns.size(); ++i) {
    const auto row = map.points.row(static_cast<Eigen::Index>(i));
    patterns.push_back(map.patterns[i].key());
    x.push_back(row.x());
    y.push_back(row.y());
    modulus.push_back(map.modulus_pa[i]);
    toughness.push_back(map.toughness_pa[i]);
  }
  for (const families::Triangle& triangle : families::delaunay(map.points))
    triangles.push_back({triangle[0], triangle[1], triangle[2]});
  return {{"id", map.id},
          {"pattern", patterns},
          {"source", map.source},
          {"x", x},
          {"y", y},
          {"modulus_pa", modulus},
          {"toughness_pa", toughness},
          {"triangles", triangles},
          {"residual_variance", map.residual_variance < 0.0 ? Json(nullptr) : Json(map.residual_variance)}};
}

Result<PatternMap> map_of_gamut(const run::Gamut& gamut, int round, const std::function<void(double)>& progress) {
  PatternMap map;
  map.id = fmt::format("gamut/{}", round);
  for (const std::size_t i : best_of(gamut, kMostMapped)) {
    map.patterns.emplace_back(gamut.patterns[i]);
    map.source.emplace_back("gamut");
    map.modulus_pa.push_back(gamut.performances[i].modulus_pa);
    map.toughness_pa.push_back(gamut.performances[i].toughness_pa);
  }
  if (map.patterns.size() < kFewestMapped)
    return fail("a map needs at least {} patterns, the gamut of round {} has {}", kFewestMapped, round,
                map.patterns.size());
  const families::Embedding embedding =
      families::isomap(families::earth_movers_distances(map.patterns, progress), kNeighbours);
  map.points = embedding.points;
  map.residual_variance = embedding.residual_variance;
  return map;
}

Json FamilyFolder::families() const {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(folder_ / "families.json", unreadable)) return Json::array();
  Json listed = Json::parse(read_file_up_to(folder_ / "families.json", kMostFileBytes), nullptr, false);
  if (!listed.is_array()) return Json::array();
  Json families = Json::array();
  for (Json& family : listed) {
    if (!family.is_object() || !family.value("name", Json()).is_string()) continue;
    const auto name = family["name"].get<std::string>();
    if (!families::is_family_name(name)) continue;
    Json ids = Json::array();
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / name, unreadable)) {
      const std::string seed = entry.path().stem().string();
      if (entry.path().extension() == ".csv" && pattern::pattern_from_key(seed)) ids.push_back(name + "/" + seed);
    }
    family["map_ids"] = ids;
    families.push_back(std::move(family));
  }
  return families;
}

Result<PatternMap> FamilyFolder::map(const std::string& id) const {
  const std::size_t slash = id.find('/');
  const std::string family = id.substr(0, slash), seed = slash == std::string::npos ? "" : id.substr(slash + 1);
  if (!families::is_family_name(family) || !pattern::pattern_from_key(seed))
    return fail("map: `{}`, expected FAMILY/SEED", id);
  try {
    auto map = map_from_csv(read_file_up_to(folder_ / family / (seed + ".csv"), kMostFileBytes), id);
    if (map) map->id = id;
    return map;
  } catch (const InputError&) {
    return fail("there is no map `{}`", id);
  }
}

Grouping FamilyFolder::grouping(std::span<const families::MeasuredPattern> measured, int rank) const {
  Grouping grouping{.families = {}, .near_pareto = {}, .from = "proposal", .problem = ""};
  const std::vector<families::MeasuredPattern> near = families::near_pareto(measured, rank);
  for (const families::MeasuredPattern& member : near) grouping.near_pareto.push_back(member.pattern);
  if (!near.empty()) grouping.families = families::proposed_families(near);
  std::error_code unreadable;
  const std::filesystem::path file = folder_ / "families.toml";
  if (std::filesystem::is_regular_file(file, unreadable)) {
    try {
      auto kept = families::parse_families(read_file_up_to(file, kMostFileBytes), "families.toml");
      if (kept == grouping.families) return grouping;  // the programs write their proposals into the file, too
      grouping.families = std::move(kept);
      grouping.from = "file";
    } catch (const InputError& error) {
      grouping.problem = error.what();
    }
  }
  return grouping;
}

Result<material::ParameterSet> FamilyFolder::model(const std::string& family) const {
  if (!families::is_family_name(family)) return fail("family: `{}` is no name of a family", family);
  try {
    return material::read_parameters(folder_ / family / "parameters.toml", material::default_parameters());
  } catch (const InputError&) {
    return fail("family {}: its model (parameters.toml) cannot be read", family);
  }
}

Result<Json> between(std::string_view patterns, std::string_view weights) {
  constexpr std::size_t kMost = 3;
  const auto keys = parts(patterns), shares = parts(weights);
  if (keys.size() > kMost || keys.size() != shares.size())
    return fail("{} patterns and {} weights, expected up to {} patterns and a weight for each", keys.size(),
                shares.size(), kMost);
  std::vector<pattern::Pattern> sources;
  std::vector<double> amounts;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto pattern = pattern::pattern_from_key(keys[i]);
    const auto amount = number_from_text(shares[i]);
    if (!pattern) return fail("patterns: `{}`, expected a key of 14 hex digits", keys[i]);
    if (!amount || *amount < 0.0 || *amount > 1.0)
      return fail("weights: `{}`, expected a number from 0 to 1", shares[i]);
    if (*amount <= 1e-6) continue;  // barycentre() asks for positive weights
    sources.push_back(*pattern);
    amounts.push_back(*amount);
  }
  if (sources.empty()) return fail("weights: all are 0, expected one above 0");
  const auto pattern = families::barycentre(sources, amounts, families::BarycentreCut::amount);
  if (!pattern) return Json{{"pattern", nullptr}, {"violation", "these patterns have no soft material to move"}};
  return Json{{"pattern", pattern->key()},
              {"rigid_fraction", pattern->rigid_fraction()},
              {"violation", json_or_null(pattern::violation(*pattern))}};
}

}  // namespace nacre::dashboard
