#include "report/report_figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "game/standings.hpp"
#include "measurement/observe.hpp"
#include "optimize/pareto.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

constexpr double kPaPerGpa = 1e9, kPaPerMpa = 1e6;

}  // namespace

PlotPoint to_point(const optimize::Performance& p) { return {p.modulus_pa / kPaPerGpa, p.toughness_pa / kPaPerMpa}; }

std::vector<PlotPoint> to_points(std::span<const optimize::Performance> performances) {
  std::vector<PlotPoint> points;
  for (const optimize::Performance& p : performances) points.push_back(to_point(p));
  return points;
}

Range range_of(std::span<const PlotPoint> points, double PlotPoint::*coordinate) {
  std::vector<double> values;
  for (const PlotPoint& p : points) values.push_back(p.*coordinate);
  return range_with_zero(values);
}

std::vector<PlotPoint> curve_points(const tester::Curve& curve) {
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < curve.size(); ++i)
    points.push_back({100.0 * curve.strain[i], curve.stress_pa[i] / kPaPerMpa});
  return points;
}

std::map<std::string, std::vector<tester::Curve>> measured_curves(const run::RunRecord& run) {
  std::map<std::string, std::vector<tester::Curve>> curves;
  for (const run::MeasuredSpecimen& m : run.specimens) {
    const measurement::SpecimenRecord& r = m.record;
    if (r.test == tester::TestKind::toughness && r.valid && !r.curve.empty() && game::is_standard(r.conditions))
      curves[r.design.name()].push_back(r.curve);
  }
  return curves;
}

namespace {

std::vector<PlotPoint> front_points(std::span<const optimize::Performance> performances) {
  return to_points(optimize::pareto_front(performances));
}

/// Everything that the gamut figures show, so that all of them share their axes.
std::vector<PlotPoint> all_points(const run::RunRecord& run, std::span<const MeasuredPattern> measured) {
  std::vector<PlotPoint> points;
  for (const auto& [number, round] : run.rounds) {
    for (const optimize::Performance& p : gamut_of(round).performances) points.push_back(to_point(p));
    if (round.model)
      for (const optimize::Performance& p : round.model->benchmark) points.push_back(to_point(p));
    for (const wire::ProposedDesign& p : round.proposals) points.push_back(to_point(predicted(p)));
  }
  for (const MeasuredPattern& m : measured) {
    points.push_back(to_point({m.mean.modulus_pa + m.modulus_sd_pa, m.mean.toughness_pa + m.toughness_sd_pa}));
  }
  return points;
}

void draw_measured(Plot& plot, std::span<const MeasuredPattern> measured, int round) {
  std::vector<optimize::Performance> all;
  for (const bool is_new : {false, true}) {
    std::vector<PlotPoint> points, bars;
    std::vector<std::string> hints;
    for (const MeasuredPattern& m : measured) {
      if ((m.round == round) != is_new) continue;
      all.push_back(m.mean);
      points.push_back(to_point(m.mean));
      bars.push_back({m.modulus_sd_pa / kPaPerGpa, m.toughness_sd_pa / kPaPerMpa});
      hints.push_back(
          fmt::format("{}: measured E {:.3g} GPa, T {:.3g} MPa", m.pattern.key(), points.back().x, points.back().y));
    }
    const Ink ink = is_new ? Ink::measured : Ink::earlier;
    plot.error_bars(points, bars, ink);
    plot.dots(points, ink, is_new ? "measured this round" : "measured before", hints);
  }
  plot.staircase(front_points(all), Ink::measured, "measured front");
}

std::string gamut_figure(const run::RunRecord& run, int number, const Range& x, const Range& y) {
  const run::RoundRecord& round = run.rounds.at(number);
  const bool lacks_messages = round.gamut_count > 0 && !round.is_gamut_whole;
  Plot plot({.title = fmt::format("Round {}{}", number, lacks_messages ? ": the gamut is incomplete" : ""),
             .x_label = "Young's modulus E (GPa)",
             .y_label = "toughness T (MPa)",
             .x = x,
             .y = y,
             .width = 540,
             .height = 400});
  plot.cloud(to_points(thinned(gamut_of(round).performances, kMostGamutPoints)), Ink::simulated, "simulated patterns");
  const std::vector<PlotPoint> mixtures = to_points(run::line_as_measured(round));
  plot.line(mixtures, Ink::homogeneous, Stroke::dashed, "homogeneous mixtures");
  plot.dots(mixtures, Ink::homogeneous, "");
  plot.staircase(front_points(gamut_of(round).performances), Ink::simulated, "simulated front");
  draw_measured(plot, measured_patterns(run, number), number);
  std::vector<PlotPoint> proposals;
  std::vector<std::string> hints;
  for (const wire::ProposedDesign& p : round.proposals) {
    proposals.push_back(to_point(predicted(p)));
    hints.push_back(fmt::format("{}: predicted E {:.3g} GPa, T {:.3g} MPa", p.design.name(), proposals.back().x,
                                proposals.back().y));
  }
  plot.rings(proposals, Ink::simulated, "proposed", hints);
  return plot.svg();
}

bool has_measurements(const wire::RoundSummary& summary) { return summary.measured_hypervolume_staircase > 0.0; }

/// One figure of the closed rounds as points over the round's number; `counts` says which rounds have it.
template <class Value, class Counts = decltype(&has_measurements)>
std::vector<PlotPoint> over_rounds(const run::RunRecord& run, Value value, Counts counts = has_measurements) {
  std::vector<PlotPoint> points;
  for (const auto& [number, round] : run.rounds) {
    if (round.summary && counts(*round.summary)) points.push_back({static_cast<double>(number), value(*round.summary)});
  }
  return points;
}

Axes round_axes(std::string title, std::string y_label, std::span<const PlotPoint> points,
                std::span<const PlotPoint> more) {
  std::vector<PlotPoint> all(points.begin(), points.end());
  all.insert(all.end(), more.begin(), more.end());
  double last = 1.0;
  for (const PlotPoint& p : all) last = std::max(last, p.x);
  return {.title = std::move(title),
          .x_label = "round",
          .y_label = std::move(y_label),
          .x = {-0.25, last + 0.25},
          .y = range_of(all, &PlotPoint::y),
          .height = 250,
          .whole_numbers_x = true};
}

void line_with_dots(Plot& plot, std::span<const PlotPoint> points, Ink ink, std::string_view label) {
  plot.line(points, ink, Stroke::solid, label);
  plot.dots(points, ink, "");
}

std::string hypervolume_figure(const run::RunRecord& run) {
  const auto gamut = over_rounds(
      run, [](const auto& s) { return s.gamut_hypervolume_staircase; }, [](const auto&) { return true; });
  const auto measured = over_rounds(run, [](const auto& s) { return s.measured_hypervolume_staircase; });
  const auto low =
      over_rounds(run, [](const auto& s) { return s.measured_hypervolume_staircase - s.hypervolume_error; });
  const auto high =
      over_rounds(run, [](const auto& s) { return s.measured_hypervolume_staircase + s.hypervolume_error; });
  std::vector<PlotPoint> more(high);
  more.insert(more.end(), measured.begin(), measured.end());
  Plot plot(round_axes("Hypervolume", "GPa MPa", gamut, more));
  plot.band(low, high, Ink::measured, "");
  line_with_dots(plot, gamut, Ink::simulated, "simulated front");
  line_with_dots(plot, measured, Ink::measured, "measured front, ± 1 standard error");
  return plot.svg();
}

std::string gap_figure(const run::RunRecord& run) {
  const auto gap = over_rounds(run, [](const auto& s) { return s.gap; });
  Plot plot(round_axes("Gap between simulation and laboratory", "GPa MPa", gap, {}));
  line_with_dots(plot, gap, Ink::simulated, "area between the two fronts");
  return plot.svg();
}

std::string signed_gap_figure(const run::RunRecord& run) {
  const auto gap = over_rounds(run, [](const auto& s) { return s.signed_gap; });
  const auto low = over_rounds(run, [](const auto& s) { return -2.0 * s.hypervolume_error; });
  const auto high = over_rounds(run, [](const auto& s) { return 2.0 * s.hypervolume_error; });
  std::vector<PlotPoint> more(low);
  more.insert(more.end(), high.begin(), high.end());
  Plot plot(round_axes("Signed gap: simulated less measured", "GPa MPa", gap, more));
  plot.band(low, high, Ink::measured, "± 2 standard errors");
  plot.zero_line();
  line_with_dots(plot, gap, Ink::simulated, "signed gap");
  return plot.svg();
}

/// What is known of one design's stress-strain curves.
struct DesignCurves {
  std::string design;
  int measured_in = 0;
  int model = -1;  ///< round of the model; -1: no model has a curve
  tester::Curve simulated;
  std::vector<tester::Curve> valid, invalid;
};

DesignCurves& curves_of(std::vector<DesignCurves>& all, const std::string& design) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const DesignCurves& c) { return c.design == design; });
  if (found != all.end()) return *found;
  all.push_back({});
  all.back().design = design;
  return all.back();
}

struct LatestSimulation {
  int round = 0;  ///< the last with a model that simulates so
  const wire::SimulatedDesign* simulation = nullptr;
};

/// By design, of the newest model that simulated it.
std::map<std::string, LatestSimulation> latest_simulations(const run::RunRecord& run) {
  std::map<std::string, LatestSimulation> latest;
  int first_of_model = 0, newest = 0;
  for (const auto& [number, round] : run.rounds) {
    if (!round.model) continue;
    if (!round.repeats_model) first_of_model = number;
    newest = number;
    for (const auto& [design, simulation] : round.simulated) latest[design] = {number, &simulation};
  }
  for (auto& [design, each] : latest)
    if (each.round >= first_of_model) each.round = newest;
  return latest;
}

/// Notched specimens tested under standard conditions; the simulated curve as the testing machine would record it.
std::vector<DesignCurves> collect_curves(const run::RunRecord& run) {
  std::vector<DesignCurves> all;
  for (const run::MeasuredSpecimen& m : run.specimens) {
    const measurement::SpecimenRecord& r = m.record;
    if (r.test != tester::TestKind::toughness || r.curve.empty() || !r.design.layout()) continue;
    if (!game::is_standard(r.conditions)) continue;
    DesignCurves& known = curves_of(all, r.design.name());
    (r.valid ? known.valid : known.invalid).push_back(r.curve);
    known.measured_in = std::max(known.measured_in, m.measured_in);
  }
  for (const auto& [design, latest] : latest_simulations(run)) {
    if (latest.simulation->curve.empty()) continue;
    DesignCurves& known = curves_of(all, design);
    known.model = latest.round;
    known.simulated = measurement::observe_curve(latest.simulation->curve, extensions_of(run.rounds.at(latest.round)));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const DesignCurves& a, const DesignCurves& b) { return a.measured_in > b.measured_in; });
  return all;
}

std::vector<PlotPoint> points_of(const DesignCurves& curves) {
  std::vector<PlotPoint> points = curve_points(curves.simulated);
  for (const auto* list : {&curves.valid, &curves.invalid}) {
    for (const tester::Curve& curve : *list) {
      for (const PlotPoint& p : curve_points(curve)) points.push_back(p);
    }
  }
  return points;
}

std::string curve_figure(const DesignCurves& curves, const Range& x, const Range& y) {
  Plot plot({.title = fmt::format("{}, round {}", shortened(curves.design), curves.measured_in),
             .x_label = "nominal strain (%)",
             .y_label = "nominal stress (MPa)",
             .x = x,
             .y = y,
             .width = 262,
             .height = 210});
  for (std::size_t i = 0; i < curves.invalid.size(); ++i) {
    plot.line(curve_points(curves.invalid[i]), Ink::earlier, Stroke::dashed, i == 0 ? "invalid" : "");
  }
  for (std::size_t i = 0; i < curves.valid.size(); ++i) {
    plot.line(curve_points(curves.valid[i]), Ink::measured, Stroke::thin, i == 0 ? "measured" : "");
  }
  plot.line(curve_points(curves.simulated), Ink::simulated, Stroke::solid,
            fmt::format("model of round {}", curves.model));
  return plot.svg();
}

}  // namespace

std::set<int> shown_rounds(const run::RunRecord& run) {
  constexpr std::size_t kMost = 12;
  std::vector<int> numbers;
  for (const auto& [number, round] : run.rounds) numbers.push_back(number);
  if (numbers.size() <= kMost) return {numbers.begin(), numbers.end()};
  std::set<int> shown;
  for (std::size_t i = 0; i < kMost; ++i) shown.insert(numbers[i * (numbers.size() - 1) / (kMost - 1)]);
  return shown;
}

std::vector<std::string> gamut_figures(const run::RunRecord& run) {
  const std::vector<PlotPoint> points = all_points(run, measured_patterns(run, newest_round(run).value_or(0)));
  const Range x = range_of(points, &PlotPoint::x), y = range_of(points, &PlotPoint::y);
  std::vector<std::string> figures;
  for (const int number : shown_rounds(run)) {
    const run::RoundRecord& round = run.rounds.at(number);
    const bool has_content =
        !gamut_of(round).patterns.empty() || !round.proposals.empty() || !measured_patterns(run, number).empty();
    if (has_content) figures.push_back(gamut_figure(run, number, x, y));
  }
  return figures;
}

std::vector<std::string> round_figures(const run::RunRecord& run) {
  if (!newest_closed_round(run)) return {};
  const bool is_measured = !over_rounds(run, [](const auto&) { return 0.0; }).empty();
  if (!is_measured) return {hypervolume_figure(run)};
  return {hypervolume_figure(run), gap_figure(run), signed_gap_figure(run)};
}

std::vector<std::string> curve_figures(const run::RunRecord& run) {
  const std::vector<DesignCurves> all = collect_curves(run);
  std::vector<PlotPoint> points;
  for (const DesignCurves& curves : all) {
    for (const PlotPoint& p : points_of(curves)) points.push_back(p);
  }
  const Range x = range_of(points, &PlotPoint::x), y = range_of(points, &PlotPoint::y);
  std::vector<std::string> figures;
  for (const DesignCurves& curves : all) figures.push_back(curve_figure(curves, x, y));
  return figures;
}

}  // namespace nacre::report
