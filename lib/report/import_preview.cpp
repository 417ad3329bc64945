#include "report/import_preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "measurement/piece.hpp"
#include "report/page_style.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

constexpr std::size_t kMostPoints = 600;  // of a curve in a page

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;max-width:64em;margin:2em auto;padding:0 "
    "1em;color:var(--ink);background:var(--page)}"
    "article{display:grid;grid-template-columns:360px 1fr;gap:1.5em;border-top:1px solid var(--rule);padding:1em 0}"
    "table{border-collapse:collapse}td,th{text-align:left;padding:.15em .8em .15em 0;vertical-align:top}"
    ".warning{color:var(--bad)}h2{margin:.2em 0}ul{padding-left:1.2em}";

/// A curve in per cent and MPa, thinned out, its peak kept.
std::vector<PlotPoint> points_of(const tester::Curve& curve) {
  std::vector<PlotPoint> points;
  const std::size_t step = std::max<std::size_t>(1, curve.size() / kMostPoints);
  const auto peak = static_cast<std::size_t>(std::max_element(curve.stress_pa.begin(), curve.stress_pa.end()) -
                                             curve.stress_pa.begin());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i % step == 0 || i == peak || i + 1 == curve.size())
      points.push_back({100.0 * curve.strain[i], 1e-6 * curve.stress_pa[i]});
  }
  return points;
}

std::string figure_of(const measurement::ReducedTest& test) {
  const std::vector<PlotPoint> points = points_of(test.curve);
  std::vector<double> xs, ys;
  for (const PlotPoint& point : points) {
    xs.push_back(point.x);
    ys.push_back(point.y);
  }
  Plot plot({.title = "",
             .x_label = "strain, %",
             .y_label = "stress, MPa",
             .x = range_with_zero(xs),
             .y = range_with_zero(ys)});
  plot.line(points, Ink::measured, Stroke::solid, "measured");
  const auto on_line = [&](double stress_pa) {
    return PlotPoint{100.0 * (stress_pa / test.modulus_pa + test.toe_kept), 1e-6 * stress_pa};
  };
  const std::vector<PlotPoint> whole = {on_line(0.0), on_line(test.peak_stress_pa)},
                               straight = {on_line(test.straight_from_pa), on_line(test.straight_to_pa)};
  plot.line(whole, Ink::simulated, Stroke::dashed, "slope E");
  plot.line(straight, Ink::simulated, Stroke::solid, "straight part");
  const auto peak =
      std::max_element(test.curve.stress_pa.begin(), test.curve.stress_pa.end()) - test.curve.stress_pa.begin();
  const std::vector<PlotPoint> marks = {
      {100.0 * test.curve.strain[static_cast<std::size_t>(peak)], 1e-6 * test.peak_stress_pa},
      {100.0 * test.curve.strain.back(), 1e-6 * test.curve.stress_pa.back()}};
  const std::vector<std::string> hints = {"peak", "end"};
  plot.rings(marks, Ink::thesis, "peak, end", hints);
  return plot.svg();
}

std::string row(const std::string& name, const std::string& value) {
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>", escaped(name), escaped(value));
}

std::string cell_of(const measurement::ImportedSpecimen& one, const std::string& name) {
  const auto found = one.provenance.find(name);
  return found == one.provenance.end() ? "" : found->second;
}

std::string columns_of(const measurement::ImportedSpecimen& one) {
  std::string rows;
  for (const char* quantity :
       {"time", "extension", "force", "strain", "stress", "frequency", "storage_modulus", "amplitude", "temperature"}) {
    const std::string heading = cell_of(one, std::string(quantity) + "_column");
    if (heading.empty()) continue;
    const std::string others = cell_of(one, std::string(quantity) + "_not_taken");
    rows += row(quantity, fmt::format("{} in {}{}", heading, cell_of(one, std::string(quantity) + "_unit"),
                                      others.empty() ? "" : "; not taken: " + others));
  }
  return rows;
}

std::string decisions_of(const measurement::ImportedSpecimen& one) {
  std::string items;
  for (const std::string& each : one.decisions) items += fmt::format("<li>{}</li>", escaped(each));
  return items;
}

/// The rows of a frequency sweep, which have no curves.
std::string sweep_article_of(std::span<const measurement::ImportedSpecimen> sweep) {
  const measurement::ImportedSpecimen& first = sweep.front();
  std::string points =
      "<tr><th>specimen</th><th>E, MPa</th><th>strain rate, 1/s</th><th>temperature, °C</th><th>note</th></tr>";
  for (const auto& one : sweep) {
    const auto temperature = one.record.other_columns.find("temperature_c");
    points += fmt::format(
        "<tr><td>{}</td><td>{:.4g}</td><td>{:.3g}</td><td>{}</td><td>{}</td></tr>", escaped(one.record.specimen),
        1e-6 * one.test.modulus_pa, one.record.conditions.strain_rate_per_s,
        temperature == one.record.other_columns.end() ? "" : escaped(temperature->second), escaped(one.record.note));
  }
  std::string rows =
      row("file", fmt::format("{}, lines {} to {}, {}, {}", first.file, cell_of(first, "first_line"),
                              cell_of(sweep.back(), "last_line"), first.maker, cell_of(first, "encoding")));
  rows += row("thickness", fmt::format("{} mm", first.record.conditions.thickness_mm)) + columns_of(first);
  return fmt::format(
      "<article><div><h2>{}</h2><p>{}, sweep{}</p><table>{}</table><ul>{}</ul></div><div><table>{}</table></div>"
      "</article>\n",
      escaped(measurement::piece_of(first.record)), escaped(first.record.design.name()),
      first.record.valid ? "" : ", <b class=\"warning\">not valid</b>", rows, decisions_of(first), points);
}

std::string article_of(const measurement::ImportedSpecimen& one) {
  const measurement::ReducedTest& test = one.test;
  std::string rows = row(
      "file", fmt::format("{}, part {}, lines {} to {}, {}, {}", one.file, cell_of(one, "part"),
                          cell_of(one, "first_line"), cell_of(one, "last_line"), one.maker, cell_of(one, "encoding")));
  rows += row("E", fmt::format("{:.4g} MPa, standard error {:.2g} %", 1e-6 * test.modulus_pa,
                               100.0 * test.modulus_error_pa / test.modulus_pa));
  rows += row("T", fmt::format("{:.4g} MJ/m3", 1e-6 * test.toughness_pa));
  rows +=
      row("peak, end", fmt::format("{:.4g} MPa, {:.4g} % strain{}", 1e-6 * test.peak_stress_pa,
                                   100.0 * test.failure_strain, test.separated ? ", separated" : ", not separated"));
  rows += row("toe", test.toe_kept != 0.0 ? fmt::format("{:.3g} %, not compensated", 100.0 * test.toe_kept)
                                          : fmt::format("{:.3g} %", 100.0 * test.toe_strain));
  rows +=
      row("strain rate", fmt::format("{:.3g} 1/s, from: {}", one.record.conditions.strain_rate_per_s, one.rate_source));
  rows += row("size", fmt::format("{} x {} mm, gauge {} mm", cell_of(one, "width_mm"),
                                  one.record.conditions.thickness_mm, one.gauge_mm));
  rows += columns_of(one);
  return fmt::format(
      "<article><div>{}</div><div><h2>{}</h2><p>{}, {}{}</p><table>{}</table><ul>{}</ul></div></article>\n",
      figure_of(test), escaped(one.record.specimen), escaped(one.record.design.name()),
      tester::to_string(one.record.test), one.record.valid ? "" : ", <b class=\"warning\">not valid</b>", rows,
      decisions_of(one));
}

}  // namespace

std::string import_preview(const measurement::Import& import, const std::string& sheet) {
  std::string body =
      fmt::format("<h1>Import of {}</h1><p>{} specimens, {} refused. Nothing is written into a set yet.</p>\n",
                  escaped(sheet), import.specimens.size(), import.rejected.size());
  std::string list;
  for (const auto& fault : import.rejected)
    list += fmt::format("<li><b>refused</b> {}</li>", escaped(to_string(fault)));
  for (const std::string& warning : import.warnings) list += fmt::format("<li>{}</li>", escaped(warning));
  if (!list.empty()) body += fmt::format("<ul class=\"warning\">{}</ul>\n", list);
  for (std::span rest(import.specimens); !rest.empty();) {
    const auto end = std::find_if(rest.begin(), rest.end(), [&](const auto& each) {
      return each.line != rest.front().line || !each.test.curve.empty();
    });
    const std::size_t points = static_cast<std::size_t>(end - rest.begin());
    body += points > 0 ? sweep_article_of(rest.first(points)) : article_of(rest.front());
    rest = rest.subspan(std::max<std::size_t>(points, 1));
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Import of {}</title>"
      "<style>{}{}{}{}</style></head>\n<body>{}</body></html>\n",
      escaped(sheet), kLightColours, kDarkColours, kFigureStyle, kStyle, body);
}

}  // namespace nacre::report
