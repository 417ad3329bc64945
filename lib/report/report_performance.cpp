// Prediction errors beside the thesis' figures and trivial baselines; the best designs beside homogeneous mixtures.

#include <algorithm>

#include <fmt/format.h>

#include "optimize/pareto.hpp"
#include "report/report_data.hpp"
#include "report/report_figures.hpp"
#include "report/report_sections.hpp"
#include "report/report_text.hpp"
#include "report/thesis_figures.hpp"

namespace nacre::report {
namespace {

constexpr std::string_view kDash = "–";

std::string mean_and_max(double mean, double maximum) {
  return fmt::format("{} <small>({})</small>", percent(mean), percent(maximum));
}

std::string modulus_cell(const sysid::PredictionErrors& e) {
  return e.modulus_count ? mean_and_max(e.modulus_mean, e.modulus_max) : std::string(kDash);
}
std::string toughness_cell(const sysid::PredictionErrors& e) {
  return e.toughness_count ? mean_and_max(e.toughness_mean, e.toughness_max) : std::string(kDash);
}

std::string own_row(const store::RunRecord& run, int number, const wire::RoundSummary& s) {
  const Baselines trivial = baselines(measured_patterns(run, number));
  const auto& h = s.held_out;
  const std::string rank = h.toughness_count >= 3 ? fmt::format("{:.2f}", h.toughness_spearman) : std::string(kDash);
  return table_row(
      {fmt::format("{}", number), fmt::format("{}", s.calibration_count),
       h.modulus_count ? fmt::format("<strong>{}</strong>", percent(h.modulus_mean)) : std::string(kDash),
       h.toughness_count ? fmt::format("<strong>{}</strong>", percent(h.toughness_mean)) : std::string(kDash), rank,
       percent_or_dash(trivial.linear_modulus), percent_or_dash(trivial.constant_toughness), modulus_cell(s.before),
       modulus_cell(s.after), toughness_cell(s.before), toughness_cell(s.after)});
}

std::string thesis_row(const ThesisRound& t, bool is_first, bool is_last) {
  const auto held_out = [](double value) { return value > 0.0 ? percent(value / 100.0) : std::string(kDash); };
  const auto trivial = [&](double value) { return is_last ? percent(value / 100.0) : std::string(kDash); };
  const auto pair = [](double mean, double maximum) { return mean_and_max(mean / 100.0, maximum / 100.0); };
  return table_row({fmt::format("thesis {}", t.round), fmt::format("{}", t.count), held_out(t.held_out_modulus),
                    held_out(t.held_out_toughness), std::string(kDash), trivial(kThesisLinearModulus),
                    trivial(kThesisConstantToughness), pair(t.before_modulus, t.before_modulus_max),
                    pair(t.after_modulus, t.after_modulus_max), pair(t.before_toughness, t.before_toughness_max),
                    pair(t.after_toughness, t.after_toughness_max)},
                   is_first ? "reference first-reference" : "reference");
}

std::string error_header() {
  return "<tr><th rowspan=\"2\">round</th><th rowspan=\"2\">N</th><th colspan=\"3\" class=\"group\">held out</th><th "
         "colspan=\"2\" class=\"group\">trivial "
         "baselines</th><th colspan=\"2\" class=\"group\">E, mean (max)</th><th colspan=\"2\" class=\"group\">T, mean "
         "(max)</th></tr>\n"
         "<tr><th>E</th><th>T</th><th>rank of T</th><th>E: line</th><th>T: "
         "constant</th><th>before</th><th>after</th><th>before</th><th>after</th></tr>\n";
}

std::string times(const std::optional<double>& factor, std::string_view otherwise) {
  return factor ? fmt::format("{:.2f}×", *factor) : std::string(otherwise);
}

std::string best_row(const MeasuredPattern& m, const Improvement& improvement) {
  return table_row({design_picture(m.pattern, 48), design_name(m.pattern.key()),
                    fmt::format("{:.0f} %", 100.0 * m.pattern.rigid_fraction()),
                    with_error(m.mean.modulus_pa * 1e-9, m.modulus_sd_pa * 1e-9),
                    with_error(m.mean.toughness_pa * 1e-6, m.toughness_sd_pa * 1e-6),
                    times(improvement.modulus, "T outside the line"),
                    times(improvement.toughness, "E outside the line"), fmt::format("{}", m.round)});
}

std::vector<MeasuredPattern> on_the_front(const std::vector<MeasuredPattern>& patterns) {
  std::vector<optimize::Performance> points;
  for (const MeasuredPattern& m : patterns) points.push_back(m.mean);
  const std::vector<int> ranks = optimize::non_dominated_ranks(points);
  std::vector<MeasuredPattern> front;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    if (ranks[i] == 1) front.push_back(patterns[i]);
  }
  std::stable_sort(front.begin(), front.end(),
                   [](const auto& a, const auto& b) { return a.mean.modulus_pa > b.mean.modulus_pa; });
  return front;
}

}  // namespace

std::string error_section(const store::RunRecord& run) {
  constexpr std::string_view kHeading = "Prediction errors";
  std::string rows;
  for (const auto& [number, round] : run.rounds) {
    if (round.summary) rows += own_row(run, number, *round.summary);
  }
  if (rows.empty()) rows = "<tr class=\"note\"><td colspan=\"11\">Still awaited: the end of round 0.</td></tr>\n";
  for (const ThesisRound& t : kThesisRounds)
    rows += thesis_row(t, &t == std::begin(kThesisRounds), &t == std::end(kThesisRounds) - 1);
  std::string content = paragraph(
      "<strong>Held out</strong>: what the previous round's model said of its own proposals before they were measured; "
      "the honest figure. "
      "It should beat the trivial baselines, which know nothing of structure: E on a straight line in the rigid "
      "fraction (each design left out in "
      "turn) and one best T for all, both over the patterns measured until then.");
  content += table(error_header(), rows);
  content += paragraph(
      "Mean relative errors, in brackets the largest. Before and after: on the N designs that the round's model is "
      "calibrated on. Rank: Spearman correlation, "
      "from three designs on. Thesis: Table 3.5; held-out figures derived from its Tables A.3 and A.4; its final model "
      "ranks T with 0.27, in sample.",
      "quiet");
  return section("errors", kHeading, content);
}

std::string best_designs_section(const store::RunRecord& run) {
  constexpr std::string_view kHeading = "Best designs against homogeneous mixtures";
  const auto front = on_the_front(measured_patterns(run, newest_round(run).value_or(0)));
  const std::vector<optimize::Performance> line = newest_line(run);
  if (front.empty()) return section("best", kHeading, awaited("the first pattern with both E and T measured"));
  std::string rows;
  std::optional<double> best_modulus, best_toughness;
  for (const MeasuredPattern& m : front) {
    const Improvement improvement = improvement_over(line, m.mean);
    rows += best_row(m, improvement);
    if (improvement.modulus) best_modulus = std::max(best_modulus.value_or(0.0), *improvement.modulus);
    if (improvement.toughness) best_toughness = std::max(best_toughness.value_or(0.0), *improvement.toughness);
  }
  std::string content;
  if (line.size() < 2) {
    content += awaited("the measured line of homogeneous mixtures, which the designs are compared with");
  } else {
    content +=
        paragraph(fmt::format("Largest improvement: <strong>{}</strong> in E at the same T (thesis, Table 3.3: "
                              "{:.2f}×), <strong>{}</strong> in T at the same E "
                              "(thesis: {:.2f}×).",
                              times(best_modulus, "none to give"), kThesisModulusGain,
                              times(best_toughness, "none to give"), kThesisToughnessGain));
  }
  content += table(header_row({"", "pattern", "rigid", "E (GPa)", "T (MPa)", "E gain", "T gain", "round"}), rows);
  content += paragraph(
      "The measured front, stiffest first; ± 1 standard deviation of the replicates. Gains by straight lines between "
      "the measured mixtures; a design beyond "
      "the line's E or T has none.",
      "quiet");
  return section("best", kHeading, content);
}

}  // namespace nacre::report
