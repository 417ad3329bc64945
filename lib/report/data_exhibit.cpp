#include "report/data_exhibit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/counted.hpp"
#include "pattern/design.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

using diagnosis::ConditionTrend;
using diagnosis::DataSummary;
using diagnosis::MeasuredMean;
using diagnosis::Quantity;

constexpr std::size_t kMostOpen = 12;  ///< rows of a table that is not folded

bool is_homogeneous(const MeasuredMean& mean) {
  const auto design = pattern::design_from_word(mean.design);
  return design && design->mixture() != nullptr;
}

Range widened(double low, double high) {
  const double margin = 0.08 * std::max(high - low, 0.1);
  return {low - margin, high + margin};
}

std::string words_of(const measurement::Surroundings& around) {
  std::vector<std::string> words;
  if (around.temperature_c) words.push_back(fmt::format("{:g} °C", *around.temperature_c));
  if (around.humidity_pct) words.push_back(fmt::format("{:g} % humidity", *around.humidity_pct));
  if (around.age_days) words.push_back(fmt::format("{:g} days old", *around.age_days));
  if (!around.machine.empty()) words.push_back(around.machine);
  if (around.held) words.push_back("held strain");
  return words.empty() ? std::string(kDash) : fmt::format("{}", fmt::join(words, ", "));
}

PlotPoint point_of(const MeasuredMean& mean) {
  return {std::log10(mean.conditions.strain_rate_per_s), std::log10(1e-6 * mean.mean_pa)};
}

/// What one material measured in one surrounding, by increasing rate.
std::map<std::string, std::vector<PlotPoint>> lines_of(const std::vector<const MeasuredMean*>& means) {
  std::map<std::string, std::vector<PlotPoint>> lines;
  for (const MeasuredMean* mean : means)
    lines[measurement::nominal_surroundings(mean->surroundings)].push_back(point_of(*mean));
  for (auto& [surroundings, line] : lines) std::ranges::sort(line, {}, &PlotPoint::x);
  return lines;
}

/// Moduli of homogeneous materials at several rates; empty where no material has two.
std::string rate_figure(const DataSummary& data) {
  std::map<std::string, std::vector<const MeasuredMean*>> of_material;
  for (const MeasuredMean& mean : data.means)
    if (mean.quantity == Quantity::modulus && is_homogeneous(mean)) of_material[mean.design].push_back(&mean);
  std::erase_if(of_material, [](const auto& each) {
    return std::ranges::all_of(each.second, [&](const MeasuredMean* mean) {
      return mean->conditions.strain_rate_per_s == each.second.front()->conditions.strain_rate_per_s;
    });
  });
  if (of_material.empty()) return "";
  std::vector<double> xs, ys;
  for (const auto& [material, means] : of_material) {
    for (const MeasuredMean* mean : means) {
      xs.push_back(std::log10(mean->conditions.strain_rate_per_s));
      ys.insert(ys.end(), {std::log10(1e-6 * mean->low_pa), std::log10(1e-6 * mean->high_pa)});
    }
  }
  const auto [x_low, x_high] = std::ranges::minmax(xs);
  const auto [y_low, y_high] = std::ranges::minmax(ys);
  Plot plot({.title = "Modulus against strain rate",
             .x_label = "log₁₀ of the strain rate, 1/s",
             .y_label = "log₁₀ of the modulus, MPa",
             .x = widened(x_low, x_high),
             .y = widened(y_low, y_high),
             .width = 520});
  std::size_t ink = 0;
  for (const auto& [material, means] : of_material) {
    std::vector<PlotPoint> points;
    std::vector<double> at;
    std::vector<Range> bars;
    std::vector<std::string> hints;
    for (const MeasuredMean* mean : means) {
      points.push_back(point_of(*mean));
      at.push_back(points.back().x);
      hints.push_back(fmt::format("{} {}", material, words_of(mean->surroundings)));
      bars.push_back({std::log10(1e-6 * mean->low_pa), std::log10(1e-6 * mean->high_pa)});
    }
    for (const auto& [surroundings, line] : lines_of(means)) plot.line(line, family_ink(ink), Stroke::thin, "");
    plot.error_bars(at, bars, family_ink(ink));
    plot.dots(points, family_ink(ink++), material, hints);
  }
  return plot.svg();
}

ExhibitTable mean_table(const DataSummary& data) {
  ExhibitTable table{.name = "",
                     .columns = {{"", "material"},
                                 {"", "test"},
                                 {"", "strain rate, 1/s"},
                                 {"", "thickness, mm"},
                                 {"", "orientation, °"},
                                 {"", "surroundings", "Temperature, humidity, age, machine, where noted"},
                                 {"", "quantity"},
                                 {"", "pieces", "Tests of one piece count once"},
                                 {"", "mean, MPa", "Geometric mean of the pieces"},
                                 {"", "90 % interval, MPa", "Of the mean, by the scatter of its own pieces"},
                                 {"", "scatter", "Of single pieces about the mean"}}};
  table.look = "words";
  for (const MeasuredMean& m : data.means) {
    if (!is_homogeneous(m)) continue;
    table.add({text_cell(m.design), text_cell(tester::to_string(m.test)),
               shown_cell(quantity(m.conditions.strain_rate_per_s)), shown_cell(quantity(m.conditions.thickness_mm)),
               shown_cell(fmt::format("{:.0f}", m.conditions.orientation_deg)), text_cell(words_of(m.surroundings)),
               text_cell(to_string(m.quantity)), shown_cell(fmt::format("{}", m.pieces)),
               shown_cell(quantity(1e-6 * m.mean_pa)),
               shown_cell(m.pieces > 1 ? fmt::format("{} … {}", quantity(1e-6 * m.low_pa), quantity(1e-6 * m.high_pa))
                                       : std::string(kDash)),
               shown_cell(m.pieces > 1 ? percent(m.scatter) : std::string(kDash))});
  }
  return table;
}

ExhibitTable trend_table(const std::vector<ConditionTrend>& trends) {
  ExhibitTable table{
      .name = "",
      .columns = {{"", "of"},
                  {"", "quantity"},
                  {"", "condition"},
                  {"", "from … to"},
                  {"", "pieces"},
                  {"", "changes by the factor"},
                  {"", "90 % interval"},
                  {"", "exponent of the rate", "The quantity grows as the strain rate to this power"},
                  {"", "chance", "Of a change as large by scatter alone, times the number of rows of this table"}}};
  table.look = "words";
  for (const ConditionTrend& t : trends) {
    const bool of_rate = t.exponent_low != t.exponent_high;
    table.add({text_cell(t.of), text_cell(to_string(t.quantity)), text_cell(t.condition),
               text_cell(fmt::format("{} … {}", t.from, t.to)), shown_cell(fmt::format("{}", t.pieces)),
               shown_cell(figure(t.ratio)), shown_cell(fmt::format("{} … {}", figure(t.low), figure(t.high))),
               shown_cell(of_rate ? fmt::format("{} ({} … {})", figure(t.exponent), figure(t.exponent_low),
                                                figure(t.exponent_high))
                                  : std::string(kDash)),
               shown_cell(chance(t.chance))});
  }
  return table;
}

/// What changes beyond scatter, open, and everything else, folded where that is long.
void put_trends(Exhibit& exhibit, const std::vector<ConditionTrend>& trends) {
  if (trends.empty()) return;
  if (trends.size() <= kMostOpen) return exhibit.tables.push_back(trend_table(trends));
  constexpr double kSure = 0.05;
  std::vector<ConditionTrend> sure, others;
  for (const ConditionTrend& trend : trends) (trend.chance < kSure ? sure : others).push_back(trend);
  if (!sure.empty()) exhibit.tables.push_back(trend_table(sure));
  if (others.empty()) return;
  exhibit.tables.push_back(trend_table(others));
  exhibit.tables.back().folded = fmt::format("{} that may be scatter", counted(others.size(), "change"));
}

}  // namespace

bool shows_data(const DataSummary& data) {
  return !data.trends.empty() || std::ranges::any_of(data.means, is_homogeneous);
}

Exhibit data_exhibit(const DataSummary& data) {
  Exhibit exhibit{.id = "data", .heading = "What was measured"};
  exhibit.notes.push_back(
      "Before any model: what homogeneous specimens measured, and what changes with the conditions.");
  if (std::string figure = rate_figure(data); !figure.empty()) exhibit.figures.push_back({"", std::move(figure)});
  if (ExhibitTable means = mean_table(data); !means.rows.empty()) {
    if (means.rows.size() > kMostOpen) means.folded = fmt::format("All {}", counted(means.rows.size(), "mean"));
    exhibit.tables.push_back(std::move(means));
  }
  put_trends(exhibit, data.trends);
  exhibit.fine_print.push_back(
      "Changes by least squares on logarithms, within designs or, where every piece was tested under several "
      "conditions, within pieces.");
  return exhibit;
}

}  // namespace nacre::report
