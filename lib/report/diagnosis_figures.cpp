#include "report/diagnosis_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "diagnosis/contrasts.hpp"
#include "report/report_figures.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

using diagnosis::ContrastView;
using diagnosis::Diagnosis;
using diagnosis::Feature;
using diagnosis::ResidualRow;

bool is_strain(Feature f) { return f == Feature::toe_strain; }
bool is_logarithm(Feature f) {
  return !is_strain(f) && f != Feature::knee && f != Feature::tail && f != Feature::drop && f != Feature::set_share &&
         f != Feature::toe_share && f != Feature::held_set && f != Feature::dwelled_set;
}

std::string unit_of(Feature feature) {
  return fmt::format("measured {} predicted, {}", is_logarithm(feature) ? "over" : "less", shown_unit(feature));
}

std::vector<const ResidualRow*> rows_of(const Diagnosis& d, const ContrastView& view) {
  std::vector<const ResidualRow*> rows;
  for (const ResidualRow& row : d.residuals)
    if (row.feature == view.feature && row.test == view.test) rows.push_back(&row);
  return rows;
}

/// The abscissa of a contrast, one number per row: a descriptor of the specimens, or the base model's prediction in
/// MPa.
std::vector<double> abscissae(const Diagnosis& d, const ContrastView& view,
                              const std::vector<const ResidualRow*>& rows) {
  const auto descriptor =
      static_cast<std::size_t>(std::ranges::find(d.descriptors, view.against) - d.descriptors.begin());
  std::vector<double> xs;
  for (const ResidualRow* row : rows)
    xs.push_back(view.against == diagnosis::kPredictedLevel ? 1e-6 * std::exp(row->base)
                                                            : row->descriptors.at(descriptor));
  return xs;
}

bool is_orientation(const ContrastView& view) { return view.against == "orientation"; }

std::string abscissa_label(const ContrastView& view) {
  if (view.against == diagnosis::kPredictedLevel) return fmt::format("{} predicted, MPa", in_words(view.feature));
  const std::string unit = view.against == diagnosis::kStrainRate ? " (log of 1/s)"
                           : is_orientation(view)                 ? " (degrees)"
                                                                  : "";
  return view.against + unit;
}

Range padded(std::vector<double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin = 0.06 * std::max(*high - *low, 1e-9);
  return {*low - margin, *high + margin};
}

std::string residual_figure(const Diagnosis& d, const diagnosis::Contrast& contrast) {
  const ContrastView& view = contrast.view;
  const std::vector<const ResidualRow*> rows = rows_of(d, view);
  const std::vector<double> xs = abscissae(d, view, rows);
  std::vector<PlotPoint> base, extended;
  std::vector<Range> bars;
  std::vector<std::string> hints;
  std::vector<double> ys = {0.0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ResidualRow* row = rows[i];
    const double x = xs[i];
    const double residual = row->measured - row->base;
    base.push_back({x, shown(view.feature, residual)});
    extended.push_back({x, shown(view.feature, row->measured - row->extended)});
    bars.push_back(
        {shown(view.feature, residual - row->standard_error), shown(view.feature, residual + row->standard_error)});
    hints.push_back(row->design);
    ys.insert(ys.end(), {bars.back().low, bars.back().high});
    ys.push_back(extended.back().y);
  }
  Plot plot({.title = fmt::format("{}: {:.3g} σ", in_words(view.feature), contrast.statistic),
             .x_label = abscissa_label(view),
             .y_label = unit_of(view.feature),
             .x = padded(xs),
             .y = padded(ys),
             .x_ticks = is_orientation(view) ? std::vector<double>{0.0, 90.0} : std::vector<double>{}});
  plot.zero_line();
  plot.error_bars(xs, bars, Ink::measured);
  plot.dots(base, Ink::measured, "base model", hints);
  if (d.extended_fit != d.base_fit) plot.rings(extended, Ink::simulated, "extended model", hints);
  return plot.svg();
}

std::string curve_figure(const diagnosis::GroupCurves& curves, bool extended) {
  std::vector<double> xs = {0.0}, ys = {0.0};
  for (const tester::Curve* curve : {&curves.measured, &curves.base, &curves.extended}) {
    for (const PlotPoint& p : curve_points(*curve)) xs.push_back(p.x), ys.push_back(p.y);
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
  std::vector<std::string> figures;
  for (const diagnosis::Contrast& contrast : d.contrasts) {
    if (figures.size() == most) break;
    if (!contrast.view.against.empty()) figures.push_back(residual_figure(d, contrast));
  }
  return figures;
}

FeatureFigure feature_figure(const Diagnosis& d) {
  std::map<Feature, std::pair<double, double>> sums;
  std::map<Feature, int> counts;
  for (const ResidualRow& row : d.residuals) {
    sums[row.feature].first += std::pow((row.measured - row.base) / row.standard_error, 2);
    sums[row.feature].second += std::pow((row.measured - row.extended) / row.standard_error, 2);
    ++counts[row.feature];
  }
  if (sums.size() < 3) return {};
  std::vector<PlotPoint> base, extended;
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
  std::string numbers;
  for (const std::string& hint : hints) numbers += (numbers.empty() ? "" : "; ") + hint;
  Plot plot({.title = "Residuals by feature of the curve",
             .x_label = "feature of the curve, by number",
             .y_label = "residual, standard errors",
             .x = {0.0, x},
             .y = padded(ys),
             .width = 520,
             .whole_numbers_x = true});
  plot.zero_line();
  plot.dots(base, Ink::measured, "base model", hints);
  if (d.extended_fit != d.base_fit) plot.rings(extended, Ink::simulated, "extended model", hints);
  return {plot.svg(), numbers};
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

}  // namespace nacre::report
