#include "report/paper_families.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "report/report_data.hpp"
#include "report/report_figures.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

std::string families_figure(const PaperSource& source, const std::vector<MeasuredPattern>& measured) {
  std::vector<PlotPoint> all;
  for (const MeasuredPattern& m : measured) all.push_back(to_point(m.mean));
  Plot plot({.title = "Families",
             .x_label = "Young's modulus E (GPa)",
             .y_label = "toughness T (MPa)",
             .x = range_of(all, &PlotPoint::x),
             .y = range_of(all, &PlotPoint::y),
             .width = 560,
             .height = 400});
  plot.dots(all, Ink::homogeneous, "measured patterns");
  for (std::size_t f = 0; f < source.groups.size(); ++f) {
    std::vector<PlotPoint> seeds;
    std::vector<std::string> hints;
    for (const pattern::Pattern& seed : source.groups[f].seeds) {
      const MeasuredPattern* m = find_measured(measured, seed.key());
      if (m == nullptr) continue;
      seeds.push_back(to_point(m->mean));
      hints.push_back(seed.key());
    }
    plot.dots(seeds, family_ink(f), source.groups[f].name, hints);
  }
  return plot.svg();
}

ExhibitTable seed_table(const PaperSource& source, const std::vector<MeasuredPattern>& measured) {
  ExhibitTable table{.name = "figure-3-12",
                     .columns = {{"family", "family"},
                                 {"pattern", "pattern"},
                                 {"rigid_fraction", "rigid fraction"},
                                 {"modulus_pa", "E (GPa)"},
                                 {"toughness_pa", "T (MPa)"},
                                 {"round", "measured in round"}}};
  for (const families::SeedFamily& group : source.groups) {
    for (const pattern::Pattern& seed : group.seeds) {
      const MeasuredPattern* m = find_measured(measured, seed.key());
      table.add({text_cell(group.name), design_cell(seed.key()), share_cell(seed.rigid_fraction()),
                 gpa_cell(m ? std::optional(m->mean.modulus_pa) : std::nullopt),
                 mpa_cell(m ? std::optional(m->mean.toughness_pa) : std::nullopt),
                 text_cell(m ? std::to_string(m->round) : "")});
    }
  }
  return table;
}

using MeasuredCurves = std::map<std::string, std::vector<tester::Curve>>;  // by design

/// One replicate of a design; nothing where none has a curve.
std::vector<PlotPoint> curve_of(const MeasuredCurves& curves, const std::string& design) {
  const auto found = curves.find(design);
  return found == curves.end() ? std::vector<PlotPoint>{} : curve_points(found->second[found->second.size() / 2]);
}

/// The seeds' curves and, where there are any, that of the rigid specimen.
ExhibitTable curve_table(const PaperSource& source, const MeasuredCurves& curves) {
  ExhibitTable table{.name = "figure-3-13",
                     .columns = {{"family", ""}, {"design", ""}, {"strain_percent", ""}, {"stress_mpa", ""}},
                     .on_page = false};
  const auto keep = [&](const std::string& family, const std::string& design) {
    for (const PlotPoint& p : curve_of(curves, design))
      table.add({text_cell(family), text_cell(design), number_cell(p.x), number_cell(p.y)});
  };
  for (const families::SeedFamily& group : source.groups)
    for (const pattern::Pattern& seed : group.seeds) keep(group.name, seed.key());
  if (!table.rows.empty()) keep("", "rigid");
  return table;
}

std::pair<Range, Range> ranges_of_curves(const PaperSource& source, const MeasuredCurves& curves) {
  std::vector<PlotPoint> all = curve_of(curves, "rigid");
  for (const families::SeedFamily& group : source.groups) {
    for (const pattern::Pattern& seed : group.seeds) {
      const std::vector<PlotPoint> points = curve_of(curves, seed.key());
      all.insert(all.end(), points.begin(), points.end());
    }
  }
  return {range_of(all, &PlotPoint::x), range_of(all, &PlotPoint::y)};
}

std::string curve_figure(const families::SeedFamily& group, Ink ink, const MeasuredCurves& curves, const Range& x,
                         const Range& y) {
  Plot plot({.title = group.name,
             .x_label = "nominal strain (%)",
             .y_label = "nominal stress (MPa)",
             .x = x,
             .y = y,
             .width = 350,
             .height = 260});
  if (curves.contains("rigid"))
    plot.line(curve_of(curves, "rigid"), Ink::homogeneous, Stroke::dashed, "rigid ink (VW)");
  bool first = true;
  for (const pattern::Pattern& seed : group.seeds) {
    if (!curves.contains(seed.key())) continue;
    plot.line(curve_of(curves, seed.key()), ink, Stroke::thin, first ? "seeds" : "");
    first = false;
  }
  return plot.svg();
}

}  // namespace

Exhibit family_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-12", .heading = "Figure 3-12: Families near the measured front"};
  const auto measured = measured_patterns(source.run, newest_round(source.run).value_or(0));
  if (source.groups.empty()) {
    exhibit.notes.push_back("No pattern of this run has been measured in both tests yet: there are no families.");
    return exhibit;
  }
  exhibit.figures.push_back({"figure-3-12", families_figure(source, measured)});
  exhibit.notes.push_back(
      fmt::format("Shown: {}. The thesis found four among 13 near-Pareto designs by eye. Here near-Pareto means first "
                  "or second rank; designs are grouped by earth mover's distance and properties (average linkage, "
                  "largest silhouette; one family where nothing stands apart).",
                  source.groups_from));
  exhibit.tables.push_back(seed_table(source, measured));
  return exhibit;
}

Exhibit family_curve_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-13", .heading = "Figure 3-13: Stress-strain curves of the seeds"};
  const MeasuredCurves curves = measured_curves(source.run);
  ExhibitTable table = curve_table(source, curves);
  if (table.rows.empty()) {
    exhibit.notes.push_back("No stress-strain curve of a seed was measured in this run.");
    return exhibit;
  }
  const auto [x, y] = ranges_of_curves(source, curves);
  int without = 0;
  for (std::size_t f = 0; f < source.groups.size(); ++f) {
    const families::SeedFamily& group = source.groups[f];
    const auto measured =
        std::ranges::count_if(group.seeds, [&](const pattern::Pattern& seed) { return curves.contains(seed.key()); });
    without += static_cast<int>(group.seeds.size()) - static_cast<int>(measured);
    if (measured > 0)
      exhibit.figures.push_back({"figure-3-13-" + group.name, curve_figure(group, family_ink(f), curves, x, y)});
  }
  exhibit.notes.push_back(
      fmt::format("One replicate of each seed (notched, upright), with the notched rigid specimen (VW){}. In the "
                  "thesis every seed has more than twice the failure strain of VW.",
                  curves.contains("rigid") ? "" : ", which this run did not measure"));
  if (without > 0)
    exhibit.notes.push_back(fmt::format("{} {} no measured curve.", without, without == 1 ? "seed has" : "seeds have"));
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

}  // namespace nacre::report
