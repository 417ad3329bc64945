#include "report/paper_game.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "game/standings.hpp"
#include "optimize/pareto.hpp"
#include "report/report_data.hpp"
#include "report/report_figures.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"
#include "report/thesis_figures.hpp"

namespace nacre::report {
namespace {

constexpr int kBestDesigns = 5;
constexpr double kWorthShowing = 1.5;  // times the homogeneous toughness (thesis 3.2.2)

int last_round(const PaperSource& source) { return newest_closed_round(source.run).value_or(0); }

std::vector<MeasuredPattern> measured_in_game(const PaperSource& source) {
  return measured_patterns(source.run, newest_round(source.run).value_or(0));
}

ExhibitTable gamut_data(const PaperSource& source) {
  ExhibitTable table{.name = "figure-3-2",
                     .columns = {{"round", ""}, {"what", ""}, {"design", ""}, {"modulus_pa", ""}, {"toughness_pa", ""}},
                     .on_page = false};
  const auto add = [&](int round, std::string_view what, std::string_view design, const optimize::Performance& p) {
    table.add({text_cell(std::to_string(round)), text_cell(what), text_cell(design), gpa_cell(p.modulus_pa),
               mpa_cell(p.toughness_pa)});
  };
  for (const auto& [number, round] : source.run.rounds) {
    for (const optimize::Performance& p : gamut_of(round).performances) add(number, "simulated", "", p);
    for (const optimize::Performance& p : run::line_as_measured(round)) add(number, "homogeneous", "", p);
    for (const wire::ProposedDesign& p : round.proposals) add(number, "proposed", p.design.name(), predicted(p));
    for (const MeasuredPattern& m : measured_patterns(source.run, number))
      if (m.round == number) add(number, "measured", m.pattern.key(), m.mean);
  }
  return table;
}

std::optional<double> thesis_hypervolume(const PaperSource& source, int round) {
  std::vector<optimize::Performance> points;
  for (const game::ThesisSample& sample : source.thesis.samples) {
    const bool is_known = round == 0 ? sample.number <= 10 : sample.round <= round;
    if (is_known) points.push_back({*sample.measured.modulus_pa, *sample.measured.toughness_pa});
  }
  if (points.empty() || round > 4) return std::nullopt;
  return optimize::hypervolume_staircase_gpa_mpa(points);
}

Cell equilibrium_cell(const wire::RoundSummary& s) {
  return {fmt::format("<span class=\"sentence\">{}: {}</span>", s.equilibrium ? "reached" : "not reached",
                      escaped(s.decided_by)),
          s.equilibrium ? "yes: " + s.decided_by : s.decided_by};
}

/// A figure that says something only once a pattern is measured: shown as a dash before.
Cell measured_cell(const wire::RoundSummary& s, double value) {
  Cell cell = number_cell(value);
  if (s.measured_hypervolume_staircase <= 0.0) cell.shown = "–";
  return cell;
}

ExhibitTable hypervolume_data(const PaperSource& source) {
  constexpr const char* kHypervolume = "hypervolume (GPa MPa)";
  constexpr const char* kGap = "gap between simulation and laboratory (GPa MPa)";
  ExhibitTable table{.name = "figure-3-3",
                     .columns = {{"round", "round"},
                                 {"measured_gpa_mpa", "measured front", "Area under its staircase", kHypervolume},
                                 {"hypervolume_error_gpa_mpa", "± error",
                                  "Bootstrap standard error over replicates of the measured hypervolume", kHypervolume},
                                 {"gamut_gpa_mpa", "simulated front", "Area under its staircase", kHypervolume},
                                 {"gap_gpa_mpa", "area", "Area between the two fronts", kGap},
                                 {"signed_gap_gpa_mpa", "signed", "Simulated less measured hypervolume", kGap},
                                 {"decided_by", "equilibrium", "Whether it is reached, and which comparison decided"}}};
  for (const auto& [number, round] : source.run.rounds) {
    if (!round.summary) continue;
    const wire::RoundSummary& s = *round.summary;
    table.add({text_cell(std::to_string(number)), measured_cell(s, s.measured_hypervolume_staircase),
               measured_cell(s, s.hypervolume_error), number_cell(s.gamut_hypervolume_staircase),
               measured_cell(s, s.gap), measured_cell(s, s.signed_gap), equilibrium_cell(s)});
  }
  for (int round = 0; round <= 4; ++round) {
    const auto measured = thesis_hypervolume(source, round);
    if (measured)
      table.add({text_cell(fmt::format("thesis {}", round)), number_cell(measured), number_cell(std::nullopt),
                 number_cell(std::nullopt), number_cell(std::nullopt), number_cell(std::nullopt), text_cell("")},
                TableRowKind::thesis);
  }
  return table;
}

/// Designs near the measured front (rank 1 and 2) by falling improvement in toughness.
std::vector<ComparedDesign> best_designs(const std::vector<MeasuredPattern>& measured,
                                         const std::vector<optimize::Performance>& line) {
  std::vector<optimize::Performance> points;
  for (const MeasuredPattern& m : measured) points.push_back(m.mean);
  const std::vector<int> ranks = optimize::non_dominated_ranks(points);
  std::vector<ComparedDesign> best;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (ranks[i] <= 2) best.push_back({measured[i], improvement_over(line, measured[i].mean)});
  std::ranges::stable_sort(best, std::greater{},
                           [](const ComparedDesign& b) { return b.gain.toughness.value_or(0.0); });
  if (best.size() > kBestDesigns) best.resize(kBestDesigns);
  std::ranges::stable_sort(best, std::greater{}, [](const ComparedDesign& b) { return b.measured.mean.toughness_pa; });
  return best;
}

/// Toughness of the tougher base material as this run measured it.
std::optional<double> tougher_base_pa(const run::RunRecord& run) {
  std::optional<double> best;
  for (const char* name : {"soft", "rigid"}) {
    std::vector<double> values;
    for (const run::MeasuredSpecimen& m : run.specimens) {
      if (!m.record.valid || m.record.test != tester::TestKind::toughness || m.record.design.name() != name) continue;
      if (!game::is_standard(m.record.conditions)) continue;
      if (const auto toughness = measurement::toughness_of(m.record)) values.push_back(*toughness);
    }
    if (!values.empty())
      best = std::max(best.value_or(0.0),
                      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()));
  }
  return best;
}

Cell times_cell(const std::optional<double>& factor) {
  return {factor ? fmt::format("{:.2f}×", *factor) : "–", factor ? fmt::format("{:.4g}", *factor) : ""};
}

ExhibitTable best_table(const std::vector<ComparedDesign>& best, const std::optional<double>& base_pa) {
  constexpr const char* kTimes = "times a homogeneous mixture's";
  ExhibitTable table{.name = "table-3-3",
                     .columns = {{"pattern", "pattern"},
                                 {"rigid_fraction", "rigid fraction"},
                                 {"modulus_pa", "E (GPa)"},
                                 {"toughness_pa", "T (MPa)"},
                                 {"gain_modulus", "E", "Over that of the mixture with the same T", kTimes},
                                 {"gain_toughness", "T", "Over that of the mixture with the same E", kTimes},
                                 {"gain_toughness_base", "T, times the tougher ink's",
                                  "Over the toughness of the tougher of the two inks alone"}}};
  for (const ComparedDesign& b : best) {
    const optimize::Performance& p = b.measured.mean;
    table.add({design_cell(b.measured.pattern.key()), share_cell(b.measured.pattern.rigid_fraction()),
               gpa_cell(p.modulus_pa), mpa_cell(p.toughness_pa), times_cell(b.gain.modulus),
               times_cell(b.gain.toughness),
               times_cell(base_pa ? std::optional(p.toughness_pa / *base_pa) : std::nullopt)});
  }
  int number = 0;
  for (const ThesisBest& t : kThesisBest)
    table.add({text_cell(fmt::format("thesis {}", ++number)), share_cell(0.01 * t.rigid_percent),
               gpa_cell(1e9 * t.modulus_gpa), mpa_cell(1e6 * t.toughness_mpa), times_cell(t.gain_modulus),
               times_cell(t.gain_toughness), times_cell(t.gain_base)},
              TableRowKind::thesis);
  return table;
}

std::string best_figure(const std::vector<MeasuredPattern>& measured, const std::vector<ComparedDesign>& best,
                        const std::vector<optimize::Performance>& line) {
  std::vector<PlotPoint> all, front;
  std::vector<std::string> hints;
  for (const MeasuredPattern& m : measured) all.push_back(to_point(m.mean));
  for (const ComparedDesign& b : best) {
    front.push_back(to_point(b.measured.mean));
    hints.push_back(b.measured.pattern.key());
  }
  std::vector<PlotPoint> everything = to_points(line);
  everything.insert(everything.end(), all.begin(), all.end());
  Plot plot({.title = "Best designs and homogeneous mixtures",
             .x_label = "Young's modulus E (GPa)",
             .y_label = "toughness T (MPa)",
             .x = range_of(everything, &PlotPoint::x),
             .y = range_of(everything, &PlotPoint::y),
             .width = 560,
             .height = 400});
  plot.line(to_points(line), Ink::homogeneous, Stroke::dashed, "homogeneous mixtures, measured");
  plot.dots(to_points(line), Ink::homogeneous, "");
  plot.dots(all, Ink::earlier, "measured patterns");
  plot.dots(front, Ink::measured, "best", hints);
  return plot.svg();
}

Axes error_axes(std::string title, int last) {
  return {.title = std::move(title),
          .x_label = "round",
          .y_label = "mean relative error (%)",
          .x = {-0.25, std::max(4.0, static_cast<double>(last)) + 0.25},
          .y = {0.0, 1.0},
          .width = 400,
          .height = 280,
          .whole_numbers_x = true};
}

struct ErrorLine {
  std::string label;
  Ink ink;
  Stroke stroke;
  std::vector<PlotPoint> points;
};

std::string error_figure(std::string title, int last, const std::vector<ErrorLine>& lines) {
  std::vector<PlotPoint> all;
  for (const ErrorLine& line : lines) all.insert(all.end(), line.points.begin(), line.points.end());
  Axes axes = error_axes(std::move(title), last);
  axes.y = range_of(all, &PlotPoint::y);
  Plot plot(axes);
  for (const ErrorLine& line : lines) {
    plot.line(line.points, line.ink, line.stroke, line.label);
    plot.dots(line.points, line.ink, "");
  }
  return plot.svg();
}

/// Errors of a model on the thesis' designs of rounds 1 to n.
sysid::PredictionErrors thesis_errors(const PaperSource& source, int round, std::size_t model) {
  std::vector<game::FamilyDesign> designs;
  for (const game::ThesisSample& sample : source.thesis.samples)
    if (sample.round <= round)
      designs.push_back({.pattern = {},
                         .is_seed = true,
                         .measured = sample.measured,
                         .global_model = sample.simulated[model],
                         .family_model = {}});
  return game::family_errors(designs).seeds_global;
}

/// "E 12.2, 9.1, 6.9 %, T 97, 84, 76 %"
std::string thesis_out_of_sample_errors() {
  std::string modulus, toughness;
  for (const ThesisRound& t : kThesisRounds) {
    if (t.out_of_sample_modulus == 0.0) continue;
    const char* comma = modulus.empty() ? "" : ", ";
    modulus += fmt::format("{}{:.1f}", comma, t.out_of_sample_modulus);
    toughness += fmt::format("{}{:.0f}", comma, t.out_of_sample_toughness);
  }
  return fmt::format("E {} %, T {} %", modulus, toughness);
}

ExhibitTable error_table(const PaperSource& source) {
  constexpr const char* kBefore = "Relative error before the calibration of the round, on its designs";
  constexpr const char* kAfter = "Relative error of the model calibrated on these designs";
  constexpr const char* kNew = "Mean relative error of the predictions made before the designs were measured";
  ExhibitTable table{.name = "table-3-5",
                     .columns = {{"round", "round"},
                                 {"count", "designs", "How many the model of the round is calibrated on"},
                                 {"modulus_before_mean", "mean", kBefore, "E before"},
                                 {"modulus_before_max", "max", kBefore, "E before"},
                                 {"modulus_after_mean", "mean", kAfter, "E after"},
                                 {"modulus_after_max", "max", kAfter, "E after"},
                                 {"toughness_before_mean", "mean", kBefore, "T before"},
                                 {"toughness_before_max", "max", kBefore, "T before"},
                                 {"toughness_after_mean", "mean", kAfter, "T after"},
                                 {"toughness_after_max", "max", kAfter, "T after"},
                                 {"modulus_held_out_mean", "E", kNew, "out-of-sample"},
                                 {"toughness_held_out_mean", "T", kNew, "out-of-sample"}}};
  const auto add = [&](const std::string& round, int count, const sysid::PredictionErrors& before,
                       const sysid::PredictionErrors& after, const sysid::PredictionErrors& out_of_sample,
                       TableRowKind kind) {
    table.add(
        {text_cell(round), text_cell(std::to_string(count)), error_cell(before.modulus_count, before.modulus_mean),
         error_cell(before.modulus_count, before.modulus_max), error_cell(after.modulus_count, after.modulus_mean),
         error_cell(after.modulus_count, after.modulus_max), error_cell(before.toughness_count, before.toughness_mean),
         error_cell(before.toughness_count, before.toughness_max),
         error_cell(after.toughness_count, after.toughness_mean),
         error_cell(after.toughness_count, after.toughness_max),
         error_cell(out_of_sample.modulus_count, out_of_sample.modulus_mean),
         error_cell(out_of_sample.toughness_count, out_of_sample.toughness_mean)},
        kind);
  };
  for (const auto& [number, round] : source.run.rounds)
    if (round.summary)
      add(std::to_string(number), round.summary->calibration_count, round.summary->before, round.summary->after,
          round.summary->held_out, TableRowKind::own);
  for (int round = 1; round <= 4 && !source.thesis.samples.empty(); ++round) {
    const auto before = thesis_errors(source, round, 0),
               after = thesis_errors(source, round, static_cast<std::size_t>(round));
    add(fmt::format("thesis {}", round), before.modulus_count, before, after, {}, TableRowKind::thesis);
  }
  return table;
}

}  // namespace

Exhibit gamut_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-2", .heading = "Figure 3-2: Evolution of simulation and experiment"};
  exhibit.notes.push_back(
      "Simulated by the model of each round (blue), measured until then (orange), proposals (rings) and measured "
      "homogeneous mixtures (grey), on the same axes. A front's staircase bounds what it dominates.");
  std::size_t number = 0;
  for (std::string& svg : gamut_figures(source.run))
    exhibit.figures.push_back({fmt::format("figure-3-2-{}", number++), std::move(svg)});
  if (exhibit.figures.empty()) exhibit.notes = {"This run has no gamut yet: its first round is not closed."};
  exhibit.tables.push_back(gamut_data(source));
  return exhibit;
}

Exhibit hypervolume_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-3",
                  .heading = "Figure 3-3: Hypervolumes, and the gap between simulation and laboratory"};
  constexpr const char* kNames[] = {"hypervolume", "gap", "signed-gap"};
  std::size_t number = 0;
  for (std::string& svg : round_figures(source.run))
    exhibit.figures.push_back({fmt::format("figure-3-3-{}", kNames[number++]), std::move(svg)});
  if (exhibit.figures.empty()) {
    exhibit.notes.push_back("No round of this run is closed yet.");
    return exhibit;
  }
  exhibit.notes.push_back(
      "Hypervolumes are areas under the staircases, down to E = 0, T = 0. The gap is the area between the two fronts, "
      "the error a bootstrap over replicates. The thesis' measured values follow from its Tables A.3 and A.4 (its "
      "round 0 is the ten random patterns); its gap fell by an order of magnitude in four rounds, in a figure without "
      "numbers.");
  exhibit.tables.push_back(hypervolume_data(source));
  return exhibit;
}

Exhibit best_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-4", .heading = "Figure 3-4, Table 3.3: Best designs against homogeneous composites"};
  const auto measured = measured_in_game(source);
  const auto line = newest_line(source.run);
  if (measured.empty()) {
    exhibit.notes.push_back("No pattern of this run has been measured in both tests yet.");
    return exhibit;
  }
  const std::vector<ComparedDesign> best = best_designs(measured, line);
  const auto worth = std::ranges::count_if(
      best, [](const ComparedDesign& b) { return b.gain.toughness.value_or(0.0) >= kWorthShowing; });
  if (line.size() < 2) {
    exhibit.notes.push_back(
        "This run has measured no homogeneous mixtures: there is nothing to compare its designs with.");
  } else {
    exhibit.notes.push_back(
        fmt::format("Designs near the measured front (first and second rank) with the largest gain in toughness over "
                    "the homogeneous mixture of the same E. The thesis shows those above {}×; here {} of {} reach "
                    "that. Gains in E are read at the same T; a design beyond the mixtures' range has none (–).",
                    kWorthShowing, worth, best.size()));
  }
  const auto base = tougher_base_pa(source.run);
  if (base)
    exhibit.notes.push_back(
        fmt::format("The tougher ink alone was measured at {} MPa (thesis: VW, 0.070 MPa).", mpa(*base)));
  else
    exhibit.notes.push_back(
        "The inks alone were not measured in this run as notched specimens: no gain over them can be given.");
  exhibit.figures.push_back({"figure-3-4", best_figure(measured, best, line)});
  exhibit.tables.push_back(best_table(best, base));
  return exhibit;
}

Exhibit base_material_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "table-3-4", .heading = "Table 3.4: Base materials after the first system identification"};
  const auto model = source.predictions.find(0);
  ExhibitTable table{.name = "table-3-4",
                     .columns = {{"material", "material", "TB: soft ink, VW: rigid ink, IF: interface"},
                                 {"measured_modulus_pa", "measured", "", "E (GPa)"},
                                 {"simulated_modulus_pa", "simulated", "", "E (GPa)"},
                                 {"modulus_error", "error", "", "E (GPa)"},
                                 {"measured_toughness_pa", "measured", "", "T (MPa)"},
                                 {"simulated_toughness_pa", "simulated", "", "T (MPa)"},
                                 {"toughness_error", "error", "", "T (MPa)"}}};
  const auto add = [&](const std::string& name, const game::DesignValues& measured, const game::DesignValues& simulated,
                       TableRowKind kind) {
    table.add({text_cell(name), gpa_cell(measured.modulus_pa), gpa_cell(simulated.modulus_pa),
               share_cell(error_of(simulated.modulus_pa, measured.modulus_pa)), mpa_cell(measured.toughness_pa),
               mpa_cell(simulated.toughness_pa), share_cell(error_of(simulated.toughness_pa, measured.toughness_pa))},
              kind);
  };
  bool found = false;
  for (const auto& [design, name] : {std::pair{"soft", "TB"}, std::pair{"rigid", "VW"}, std::pair{"interface", "IF"}}) {
    const auto material = std::ranges::find(source.base_materials, design,
                                            [](const measurement::Replicates& each) { return each.design.name(); });
    if (model == source.predictions.end() || !model->second.contains(design) || material == source.base_materials.end())
      continue;
    found = true;
    add(name, {.modulus_pa = material->modulus_pa, .toughness_pa = material->toughness_pa}, model->second.at(design),
        TableRowKind::own);
  }
  for (const game::ThesisMaterial& material : source.thesis.materials)
    add("thesis " + material.name, material.measured, material.simulated, TableRowKind::thesis);
  exhibit.notes.push_back(
      found ? "The model of round 0 on the measurements that it was fitted to (<code>base_materials_file</code>)."
            : "The base materials, or the predictions of round 0's model for them, are not in this folder "
              "(they stand in inputs/ and in the validation agent's journal).");
  exhibit.tables.push_back(table);
  return exhibit;
}

Exhibit error_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-7",
                  .heading = "Figure 3-7, Table 3.5: Prediction errors before and after system identification"};
  const ExhibitTable table = error_table(source);
  for (const bool toughness : {false, true}) {
    std::vector<PlotPoint> before, after, out_of_sample, thesis;
    for (const auto& [number, round] : source.run.rounds) {
      if (!round.summary || number == 0) continue;
      const auto add = [&, n = static_cast<double>(number)](std::vector<PlotPoint>& line,
                                                            const sysid::PredictionErrors& e) {
        if ((toughness ? e.toughness_count : e.modulus_count) == 0) return;  // an error of nothing is no error of 0
        line.push_back({n, 100.0 * (toughness ? e.toughness_mean : e.modulus_mean)});
      };
      add(before, round.summary->before);
      add(after, round.summary->after);
      add(out_of_sample, round.summary->held_out);
    }
    if (before.empty() && after.empty() && out_of_sample.empty()) continue;
    for (int round = 1; round <= 4 && !source.thesis.samples.empty(); ++round) {
      const auto errors = thesis_errors(source, round, static_cast<std::size_t>(round));
      thesis.push_back({static_cast<double>(round), 100.0 * (toughness ? errors.toughness_mean : errors.modulus_mean)});
    }
    exhibit.figures.push_back({fmt::format("figure-3-7-{}", toughness ? "toughness" : "modulus"),
                               error_figure(toughness ? "Toughness" : "Young's modulus", last_round(source),
                                            {{"before", Ink::earlier, Stroke::solid, before},
                                             {"after", Ink::simulated, Stroke::solid, after},
                                             {"out-of-sample", Ink::measured, Stroke::solid, out_of_sample},
                                             {"thesis, after", Ink::thesis, Stroke::dashed, thesis}})});
  }
  exhibit.notes.push_back(fmt::format(
      "Before: the model that the round began with, on the designs of the round. After: the model calibrated on them. "
      "The thesis' “before” is its first model (fitted to the base materials) in every round. Out-of-sample: the "
      "round's proposals as predicted before they were measured, which says how far the model can be trusted; for the "
      "thesis it follows from Tables A.3 and A.4: {} in rounds 2 to 4.",
      thesis_out_of_sample_errors()));
  if (last_round(source) == 0) exhibit.notes.push_back("This run has no measured round yet.");
  exhibit.tables.push_back(table);
  return exhibit;
}

}  // namespace nacre::report
