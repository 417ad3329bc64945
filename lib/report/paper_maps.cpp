#include "report/paper_maps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "families/barycentre.hpp"
#include "families/interpolation.hpp"
#include "report/design_picture.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

constexpr int kExamples = 6;  // patterns shown with a map

const std::string kNoMaps =
    "This run has no maps of its families yet: call <code>nacre families --run RUN</code>, then this command again.";

/// E in the blue channel, T in the red one, as the thesis colours its maps; over the ranges of one map.
struct Colours {
  double modulus_low = 1e300, modulus_high = -1e300, toughness_low = 1e300, toughness_high = -1e300;

  explicit Colours(const SubfamilyMap& map) {
    for (const MapPoint& point : map.points) {
      if (!point.performance) continue;
      modulus_low = std::min(modulus_low, point.performance->modulus_pa);
      modulus_high = std::max(modulus_high, point.performance->modulus_pa);
      toughness_low = std::min(toughness_low, point.performance->toughness_pa);
      toughness_high = std::max(toughness_high, point.performance->toughness_pa);
    }
  }
  std::string of(const MapPoint& point) const {
    if (!point.performance) return "#999999";
    const auto level = [](double value, double low, double high) {
      return high > low ? static_cast<int>(std::lround(40.0 + 215.0 * (value - low) / (high - low))) : 128;
    };
    return fmt::format("#{:02x}40{:02x}", level(point.performance->toughness_pa, toughness_low, toughness_high),
                       level(point.performance->modulus_pa, modulus_low, modulus_high));
  }
};

Range span_of(const std::vector<PlotPoint>& points, double PlotPoint::*coordinate) {
  Range range{1e300, -1e300};
  for (const PlotPoint& p : points) {
    range.low = std::min(range.low, p.*coordinate);
    range.high = std::max(range.high, p.*coordinate);
  }
  const double margin = 0.05 * std::max(range.high - range.low, 1e-9);
  return {range.low - margin, range.high + margin};
}

std::string map_picture(const SubfamilyMap& map, bool refined, const std::string& title) {
  const Colours colours(map);
  std::vector<PlotPoint> points;
  std::vector<std::string> inks;
  for (const MapPoint& point : map.points) {
    if (!refined && !point.x_sampled) continue;
    points.push_back(refined ? PlotPoint{point.x, point.y} : PlotPoint{*point.x_sampled, *point.y_sampled});
    inks.push_back(colours.of(point));
  }
  Plot plot({.title = title,
             .x_label = "Isomap 1 (pixels of transport)",
             .y_label = "Isomap 2",
             .x = span_of(points, &PlotPoint::x),
             .y = span_of(points, &PlotPoint::y),
             .width = 400,
             .height = 340});
  plot.coloured(points, inks);
  return plot.svg();
}

/// Patterns spread over the map: each the farthest from those before, the seed first.
std::vector<const MapPoint*> examples_of(const SubfamilyMap& map) {
  std::vector<const MapPoint*> chosen = {&map.points.front()};
  while (chosen.size() < std::min<std::size_t>(kExamples, map.points.size())) {
    const MapPoint* farthest = nullptr;
    double largest = -1.0;
    for (const MapPoint& point : map.points) {
      double nearest = 1e300;
      for (const MapPoint* other : chosen)
        nearest = std::min(nearest, std::hypot(point.x - other->x, point.y - other->y));
      if (nearest > largest) largest = nearest, farthest = &point;
    }
    chosen.push_back(farthest);
  }
  return chosen;
}

std::string tile(const pattern::Pattern& pattern, int column, int row, const std::string& caption) {
  constexpr int kTile = 92, kSide = 74;
  std::string picture = design_picture(pattern, kSide);
  picture.insert(4, fmt::format(" x=\"{}\" y=\"{}\"", column * kTile + 8, row * (kTile + 14) + 26));
  return picture + fmt::format("<text x=\"{}\" y=\"{}\" class=\"tick middle\">{}</text>",
                               column * kTile + 8 + kSide / 2, row * (kTile + 14) + 26 + kSide + 13, escaped(caption));
}

std::string tiles(const std::string& title, int columns, int rows, const std::string& content) {
  return fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"{2}\"><text "
      "x=\"8\" y=\"16\" class=\"title\">{2}</text>{3}</svg>\n",
      columns * 92 + 8, rows * 106 + 26, escaped(title), content);
}

std::string example_picture(const SubfamilyMap& map) {
  std::string content;
  int column = 0;
  for (const MapPoint* point : examples_of(map)) {
    content += tile(point->pattern, column++, 0,
                    point->performance ? fmt::format("{:.2f}, {:.2f}", 1e-9 * point->performance->modulus_pa,
                                                     1e-6 * point->performance->toughness_pa)
                                       : point->source);
  }
  return tiles("Patterns far apart on the map; E (GPa), T (MPa)", kExamples, 1, content);
}

Eigen::MatrixX2d points_before(const SubfamilyMap& map, std::vector<pattern::Pattern>& members) {
  std::vector<const MapPoint*> known;
  for (const MapPoint& point : map.points)
    if (point.x_sampled && point.y_sampled) known.push_back(&point);
  Eigen::MatrixX2d points(static_cast<Eigen::Index>(known.size()), 2);
  for (std::size_t i = 0; i < known.size(); ++i) {
    members.push_back(known[i]->pattern);
    points.row(static_cast<Eigen::Index>(i)) << *known[i]->x_sampled, *known[i]->y_sampled;
  }
  return points;
}

/// Barycentres of the corners of one triangle of the map, weights in quarters; empty when the map has no triangle that
/// the edge rule admits.
std::string interpolation_picture(const SubfamilyMap& map, ExhibitTable& table) {
  std::vector<pattern::Pattern> members;
  const Eigen::MatrixX2d points = points_before(map, members);
  if (members.size() < 4) return "";
  const auto triangles = families::candidate_triangles(points);
  if (triangles.empty()) return "";
  const auto difference = [&](const families::Triangle& t) {
    const auto at = [&](int i) -> const pattern::Pattern& { return members[t[i]]; };
    return pattern::pixel_difference(at(0), at(1)) + pattern::pixel_difference(at(1), at(2)) +
           pattern::pixel_difference(at(2), at(0));
  };
  const families::Triangle widest = *std::ranges::max_element(triangles, {}, difference);
  constexpr int kParts = 4;
  std::string content;
  for (int a = kParts; a >= 0; --a) {
    for (int b = kParts - a; b >= 0; --b) {
      const int parts[3] = {a, b, kParts - a - b};
      std::vector<pattern::Pattern> sources;
      std::vector<double> weights;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (parts[corner] == 0) continue;
        sources.push_back(members[widest[corner]]);
        weights.push_back(parts[corner]);
      }
      const auto between = families::barycentre(sources, weights);
      if (!between) continue;
      const std::string caption = fmt::format("{}:{}:{}", parts[0], parts[1], parts[2]);
      content += tile(*between, kParts - a - b, kParts - a, caption);
      table.add({text_cell(map.family), text_cell(map.seed), text_cell(caption), text_cell(between->key())});
    }
  }
  return tiles(fmt::format("{}, around {}", map.family, map.seed), kParts + 1, kParts + 1, content);
}

std::size_t count_of(const SubfamilyMap& map, bool interpolated) {
  return std::ranges::count_if(map.points,
                               [&](const MapPoint& p) { return (p.source == "interpolated") == interpolated; });
}

}  // namespace

Exhibit map_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-16", .heading = "Figure 3-16: Isomap embeddings of the subfamilies"};
  if (source.maps.empty()) {
    exhibit.notes.push_back(kNoMaps);
    return exhibit;
  }
  ExhibitTable table{.name = "figure-3-16",
                     .columns = {{"family", ""},
                                 {"seed", ""},
                                 {"pattern", ""},
                                 {"source", ""},
                                 {"x", ""},
                                 {"y", ""},
                                 {"modulus_pa", ""},
                                 {"toughness_pa", ""}},
                     .on_page = false};
  for (const SubfamilyMap& map : source.maps) {
    exhibit.figures.push_back({fmt::format("figure-3-16-{}-{}", map.family, map.seed),
                               map_picture(map, true, fmt::format("{}, around {}", map.family, map.seed))});
    exhibit.figures.push_back({fmt::format("figure-3-16-{}-{}-examples", map.family, map.seed), example_picture(map)});
    for (const MapPoint& p : map.points) {
      table.add({text_cell(map.family), text_cell(map.seed), text_cell(p.pattern.key()), text_cell(p.source),
                 number_cell(p.x), number_cell(p.y),
                 gpa_cell(p.performance ? std::optional(p.performance->modulus_pa) : std::nullopt),
                 mpa_cell(p.performance ? std::optional(p.performance->toughness_pa) : std::nullopt)});
    }
  }
  exhibit.notes.push_back(
      "Each point is a pattern within 16 pixels of the seed; distances follow the earth mover's distance along ten "
      "neighbours. Bluer is stiffer and redder tougher, over the range of the map. The thesis' maps hold 2000 to 3000 "
      "patterns.");
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

Exhibit interpolation_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-17", .heading = "Figure 3-17: Interpolation between three patterns"};
  ExhibitTable table{.name = "figure-3-17",
                     .columns = {{"family", ""}, {"seed", ""}, {"weights", ""}, {"pattern", ""}},
                     .on_page = false};
  for (const SubfamilyMap& map : source.maps) {
    std::string picture = interpolation_picture(map, table);
    if (!picture.empty())
      exhibit.figures.push_back({fmt::format("figure-3-17-{}-{}", map.family, map.seed), std::move(picture)});
    if (exhibit.figures.size() == 2) break;
  }
  if (exhibit.figures.empty()) {
    exhibit.notes.push_back(
        source.maps.empty()
            ? kNoMaps
            : "No triangle of the maps satisfies the edge rule (longest edge 4 to 40 % of the diameter).");
    return exhibit;
  }
  exhibit.notes.push_back(
      "Wasserstein barycentres of the corners of one Delaunay triangle of the map, with their weights; the three "
      "corners are the sources themselves.");
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

Exhibit refinement_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-18", .heading = "Figure 3-18: Maps before and after interpolation"};
  for (const SubfamilyMap& map : source.maps) {
    const bool has_before = std::ranges::any_of(map.points, [](const MapPoint& p) { return p.x_sampled.has_value(); });
    if (!has_before || count_of(map, true) == 0) continue;
    for (const bool refined : {false, true})
      exhibit.figures.push_back(
          {fmt::format("figure-3-18-{}-{}-{}", map.family, map.seed, refined ? "after" : "before"),
           map_picture(map, refined,
                       fmt::format("{}, around {}: {}", map.family, map.seed, refined ? "after" : "before"))});
  }
  if (exhibit.figures.empty())
    exhibit.notes.push_back(source.maps.empty() ? kNoMaps : "Interpolation added no pattern to any of the maps.");
  else
    exhibit.notes.push_back(
        "Left the patterns of dense sampling, right the map of them and of those that interpolation added.");
  return exhibit;
}

Exhibit growth_appendix(const PaperSource& source) {
  Exhibit exhibit{.id = "table-a-7", .heading = "Table A.7: Growth of the subfamilies by interpolation"};
  if (source.maps.empty()) {
    exhibit.notes.push_back(kNoMaps + " The thesis' eleven subfamilies grew by 4.52 % in all (1.75 to 7.15 %).");
    return exhibit;
  }
  ExhibitTable table{.name = "table-a-7",
                     .columns = {{"family", "family"},
                                 {"seed", "subfamily", "The variants around one seed"},
                                 {"before", "patterns before"},
                                 {"after", "patterns after"},
                                 {"growth", "increase"}}};
  std::size_t before = 0, after = 0;
  const auto row = [&](const std::string& family, Cell seed, std::size_t sampled, std::size_t all, TableRowKind kind) {
    table.add({text_cell(family), std::move(seed), text_cell(std::to_string(sampled)), text_cell(std::to_string(all)),
               share_cell(static_cast<double>(all - sampled) / static_cast<double>(sampled))},
              kind);
  };
  for (const SubfamilyMap& map : source.maps) {
    row(map.family, design_cell(map.seed), count_of(map, false), map.points.size(), TableRowKind::own);
    before += count_of(map, false);
    after += map.points.size();
  }
  row("all", text_cell(""), before, after, TableRowKind::own);
  row("thesis, all 11", text_cell(""), 24656, 25771, TableRowKind::thesis);
  exhibit.notes.push_back(
      "Growth depends on how dense the map is: few patterns leave wide triangles, with more room in them.");
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

}  // namespace nacre::report
