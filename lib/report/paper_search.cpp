#include "report/paper_search.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "optimize/pareto.hpp"
#include "report/report_figures.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

std::vector<PlotPoint> growth_of(const SearchPath& path) {
  constexpr std::size_t kStep = 10;
  std::vector<PlotPoint> points;
  std::vector<optimize::Performance> front;
  for (std::size_t i = 0; i < path.samples.size(); ++i) {
    front.push_back(path.samples[i]);
    if ((i + 1) % kStep != 0 && i + 1 != path.samples.size()) continue;
    front = optimize::pareto_front(front);
    points.push_back({static_cast<double>(i + 1), optimize::hypervolume_staircase_gpa_mpa(front)});
  }
  return points;
}

/// How many points the searches share from the first on: the last one of a search lies where it ended.
std::size_t shared_points(const std::vector<std::vector<PlotPoint>>& searches) {
  const std::size_t shortest = std::ranges::min(searches, {}, &std::vector<PlotPoint>::size).size();
  for (std::size_t i = 0; i < shortest; ++i)
    if (std::ranges::any_of(searches, [&](const auto& search) { return search[i].x != searches[0][i].x; })) return i;
  return shortest;
}

/// Mean and range over the searches of a round, as far as all of them go.
std::string growth_figure(int round, const std::vector<std::vector<PlotPoint>>& searches) {
  std::vector<PlotPoint> mean, low, high;
  const std::size_t length = shared_points(searches);
  for (std::size_t i = 0; i < length; ++i) {
    double sum = 0.0, least = searches[0][i].y, most = least;
    for (const auto& search : searches) {
      sum += search[i].y;
      least = std::min(least, search[i].y);
      most = std::max(most, search[i].y);
    }
    const double x = searches[0][i].x;
    mean.push_back({x, sum / static_cast<double>(searches.size())});
    low.push_back({x, least});
    high.push_back({x, most});
  }
  Plot plot({.title = fmt::format("Round {}", round),
             .x_label = "simulated patterns of a search",
             .y_label = "hypervolume (GPa MPa)",
             .x = range_of(mean, &PlotPoint::x),
             .y = range_of(high, &PlotPoint::y),
             .width = 400,
             .height = 280});
  if (searches.size() > 1) plot.band(low, high, Ink::simulated, "range");
  plot.line(mean, Ink::simulated, Stroke::solid,
            searches.size() == 1 ? "one search" : fmt::format("mean of {} searches", searches.size()));
  return plot.svg();
}

}  // namespace

Exhibit search_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-9", .heading = "Figure 3-9: Hypervolume growth of the gamut"};
  std::map<int, std::vector<std::vector<PlotPoint>>> by_round;
  for (const SearchPath& path : source.searches)
    if (!path.samples.empty()) by_round[path.round].push_back(growth_of(path));
  if (by_round.empty()) {
    exhibit.notes.push_back(
        "The proposal agent's journal is not in this folder: the order of its simulations is not known.");
    return exhibit;
  }
  ExhibitTable table{.name = "figure-3-9",
                     .columns = {{"round", ""}, {"search", ""}, {"simulations", ""}, {"hypervolume_gpa_mpa", ""}},
                     .on_page = false};
  for (const SearchPath& path : source.searches) {
    for (const PlotPoint& point : growth_of(path))
      table.add({text_cell(std::to_string(path.round)), text_cell(std::to_string(path.branch)), number_cell(point.x),
                 number_cell(point.y)});
  }
  for (const auto& [round, searches] : by_round) {
    const bool is_first_or_last = round == by_round.begin()->first || round == by_round.rbegin()->first;
    if (is_first_or_last && shared_points(searches) > 0)
      exhibit.figures.push_back({fmt::format("figure-3-9-round-{}", round), growth_figure(round, searches)});
  }
  exhibit.notes.push_back(
      "First and last round; simulations of one search, without those that an unchanged model took over from the round "
      "before. A game plays one algorithm; <code>nacre explore</code> compares several (docs/studies/search.md). The "
      "thesis' learned search needs 1320 and 1060 simulations where its single-pixel NSGA-II needs 20,000.");
  exhibit.tables.push_back(table);
  return exhibit;
}

}  // namespace nacre::report
