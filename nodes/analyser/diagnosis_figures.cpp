#include "analyser/diagnosis_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "analyser/report_figures.hpp"
#include "analyser/svg.hpp"

namespace nacre::analyser {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Feature;
using diagnosis::ResidualRow;

bool is_strain(Feature f) { return f == Feature::toe_strain; }
bool is_logarithm(Feature f) {
  return !is_strain(f) && f != Feature::knee && f != Feature::tail && f != Feature::drop && f != Feature::set_share &&
         f != Feature::toe_share;
}

std::string unit_of(Feature feature) {
  return fmt::format("measured {} predicted, {}", is_logarithm(feature) ? "over" : "less", shown_unit(feature));
}

/// How strongly residuals of one feature line up with one descriptor: |correlation| times their size in standard
/// errors.
struct View {
  Feature feature;
  std::size_t descriptor;
  double strength;
};

std::vector<const ResidualRow*> rows_of(const Diagnosis& d, Feature feature) {
  std::vector<const ResidualRow*> rows;
  for (const ResidualRow& row : d.residuals)
    if (row.feature == feature) rows.push_back(&row);
  return rows;
}

double strength_of(const std::vector<const ResidualRow*>& rows, std::size_t descriptor) {
  double mx = 0.0, my = 0.0;
  const double n = static_cast<double>(rows.size());
  for (const ResidualRow* row : rows)
    mx += row->descriptors[descriptor] / n, my += (row->measured - row->base) / row->standard_error / n;
  double xx = 0.0, xy = 0.0;
  for (const ResidualRow* row : rows) {
    const double x = row->descriptors[descriptor] - mx, y = (row->measured - row->base) / row->standard_error - my;
    xx += x * x, xy += x * y;
  }
  return xx > 1e-12 * n ? std::abs(xy) / std::sqrt(xx) : -1.0;
}

Range padded(std::vector<double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin = 0.06 * std::max(*high - *low, 1e-9);
  return {*low - margin, *high + margin};
}

std::string residual_figure(const Diagnosis& d, const View& view) {
  const std::vector<const ResidualRow*> rows = rows_of(d, view.feature);
  std::vector<Point> base, extended, bars;
  std::vector<std::string> hints;
  std::vector<double> xs, ys = {0.0};
  for (const ResidualRow* row : rows) {
    const double x = row->descriptors[view.descriptor];
    base.push_back({x, shown(view.feature, row->measured - row->base)});
    extended.push_back({x, shown(view.feature, row->measured - row->extended)});
    bars.push_back({0.0, 100.0 * row->standard_error});
    hints.push_back(row->design);
    xs.push_back(x);
    for (const double sign : {-1.0, 1.0}) ys.push_back(base.back().y + sign * bars.back().y);
    ys.push_back(extended.back().y);
  }
  Plot plot({.title = std::string(in_words(view.feature)),
             .x_label = d.descriptors[view.descriptor] +
                        (d.descriptors[view.descriptor] == "strain rate" ? " (log of 1/s)" : ""),
             .y_label = unit_of(view.feature),
             .x = padded(xs),
             .y = padded(ys)});
  plot.zero_line();
  plot.error_bars(base, bars, Ink::measured);
  plot.dots(base, Ink::measured, "base model", hints);
  if (d.extended_fit != d.base_fit) plot.rings(extended, Ink::simulated, "extended model", hints);
  return plot.svg();
}

std::string curve_figure(const diagnosis::GroupCurves& curves, bool extended) {
  std::vector<double> xs = {0.0}, ys = {0.0};
  for (const tester::Curve* curve : {&curves.measured, &curves.base, &curves.extended}) {
    for (const Point& p : curve_points(*curve)) xs.push_back(p.x), ys.push_back(p.y);
  }
  const std::string name = curves.design.size() > 16 ? curves.design.substr(0, 12) + "…" : curves.design;
  Plot plot({.title = fmt::format("{}, {:.2g} /s{}", name, curves.conditions.strain_rate_per_s,
                                  curves.conditions.orientation_deg == 90.0 ? ", turned" : ""),
             .x_label = "strain, %",
             .y_label = "stress, MPa",
             .x = padded(xs),
             .y = padded(ys)});
  plot.line(curve_points(curves.measured), Ink::measured, Stroke::solid, "measured");
  plot.line(curve_points(curves.base), Ink::homogeneous, Stroke::dashed, "base model");
  if (extended) plot.line(curve_points(curves.extended), Ink::simulated, Stroke::solid, "extended model");
  return plot.svg();
}

}  // namespace

double shown(Feature feature, double difference) {
  return 100.0 * (is_logarithm(feature) ? std::expm1(difference) : difference);
}

std::string_view shown_unit(Feature feature) {
  return is_logarithm(feature) ? "%" : is_strain(feature) ? "% strain" : "x 100";
}

std::vector<std::string> residual_figures(const Diagnosis& d, std::size_t most) {
  std::vector<View> views;
  for (const Feature feature : {Feature::log_modulus, Feature::log_toughness, Feature::log_peak,
                                Feature::log_tangent_30, Feature::toe_strain, Feature::toe_share}) {
    const auto rows = rows_of(d, feature);
    if (rows.size() < 3) continue;
    for (std::size_t k = 0; k < d.descriptors.size(); ++k) {
      if (const double strength = strength_of(rows, k); strength >= 0.0) views.push_back({feature, k, strength});
    }
  }
  std::stable_sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.strength > b.strength; });
  std::vector<std::string> figures;
  for (const View& view : views) {
    if (figures.size() == most) break;
    figures.push_back(residual_figure(d, view));
  }
  return figures;
}

std::string feature_figure(const Diagnosis& d) {
  std::map<Feature, std::pair<double, double>> sums;
  std::map<Feature, int> counts;
  for (const ResidualRow& row : d.residuals) {
    sums[row.feature].first += std::pow((row.measured - row.base) / row.standard_error, 2);
    sums[row.feature].second += std::pow((row.measured - row.extended) / row.standard_error, 2);
    ++counts[row.feature];
  }
  if (sums.size() < 3) return "";
  std::vector<Point> base, extended;
  std::vector<std::string> hints;
  std::vector<double> ys = {0.0, 2.0};
  double x = 1.0;
  for (const auto& [feature, squares] : sums) {
    base.push_back({x, std::sqrt(squares.first / counts[feature])});
    extended.push_back({x, std::sqrt(squares.second / counts[feature])});
    ys.push_back(base.back().y);
    ys.push_back(extended.back().y);
    hints.push_back(fmt::format("{}: {}", x, in_words(feature)));
    x += 1.0;
  }
  std::string legend;
  for (const std::string& hint : hints) legend += (legend.empty() ? "" : "; ") + hint;
  Plot plot({.title = "Where in the curve",
             .x_label = "feature (numbers below)",
             .y_label = "residual, standard errors",
             .x = {0.0, x},
             .y = padded(ys),
             .width = 520,
             .whole_numbers_x = true});
  plot.zero_line();
  plot.dots(base, Ink::measured, "base model", hints);
  if (d.extended_fit != d.base_fit) plot.rings(extended, Ink::simulated, "extended model", hints);
  return "<div>" + plot.svg() + "<p class=\"quiet\">" + escaped(legend) + "</p></div>";
}

std::vector<std::string> diagnosis_curve_figures(const Diagnosis& d, std::size_t most) {
  std::vector<std::pair<double, const diagnosis::GroupCurves*>> order;
  for (const diagnosis::GroupCurves& curves : d.curves) {
    double squares = 0.0;
    for (const ResidualRow& row : d.residuals) {
      if (row.design == curves.design && row.test == curves.test && row.conditions == curves.conditions)
        squares += std::pow((row.measured - row.base) / row.standard_error, 2);
    }
    order.emplace_back(squares, &curves);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> figures;
  for (const auto& [squares, curves] : order) {
    if (figures.size() == most) break;
    figures.push_back(curve_figure(*curves, d.extended_fit != d.base_fit));
  }
  return figures;
}

}  // namespace nacre::analyser
