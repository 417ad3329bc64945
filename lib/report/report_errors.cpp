#include "report/report_errors.hpp"

#include <fmt/format.h>

#include "report/report_data.hpp"
#include "report/report_text.hpp"
#include "report/thesis_figures.hpp"

namespace nacre::report {
namespace {

constexpr std::string_view kDash = "–";

Cell dash() { return shown_cell(std::string(kDash)); }

Cell mean_and_max(double mean, double maximum) {
  return shown_cell(fmt::format("{} <small>({})</small>", percent(mean), percent(maximum)));
}

Cell modulus_cell(const sysid::PredictionErrors& e) {
  return e.modulus_count ? mean_and_max(e.modulus_mean, e.modulus_max) : dash();
}
Cell toughness_cell(const sysid::PredictionErrors& e) {
  return e.toughness_count ? mean_and_max(e.toughness_mean, e.toughness_max) : dash();
}
Cell strong_cell(int count, double error) {
  return count ? shown_cell(fmt::format("<strong>{}</strong>", percent(error))) : dash();
}

std::vector<Cell> own_row(const run::RunRecord& run, int number, const wire::RoundSummary& s) {
  const Baselines trivial = baselines(measured_patterns(run, number));
  const auto& new_designs = s.held_out;
  return {text_cell(fmt::format("{}", number)),
          text_cell(fmt::format("{}", s.calibration_count)),
          strong_cell(new_designs.modulus_count, new_designs.modulus_mean),
          strong_cell(new_designs.toughness_count, new_designs.toughness_mean),
          new_designs.toughness_count >= 3 ? text_cell(fmt::format("{:.2f}", new_designs.toughness_spearman)) : dash(),
          share_cell(trivial.linear_modulus),
          share_cell(trivial.constant_toughness),
          modulus_cell(s.before),
          modulus_cell(s.after),
          toughness_cell(s.before),
          toughness_cell(s.after)};
}

std::vector<Cell> thesis_row(const ThesisRound& t, bool is_last) {
  const auto if_any = [](double value) { return value > 0.0 ? share_cell(value / 100.0) : dash(); };
  const auto trivial = [&](double value) { return is_last ? share_cell(value / 100.0) : dash(); };
  const auto pair = [](double mean, double maximum) { return mean_and_max(mean / 100.0, maximum / 100.0); };
  return {text_cell(fmt::format("thesis {}", t.round)),
          text_cell(fmt::format("{}", t.count)),
          if_any(t.out_of_sample_modulus),
          if_any(t.out_of_sample_toughness),
          dash(),
          trivial(kThesisLinearModulus),
          trivial(kThesisConstantToughness),
          pair(t.before_modulus, t.before_modulus_max),
          pair(t.after_modulus, t.after_modulus_max),
          pair(t.before_toughness, t.before_toughness_max),
          pair(t.after_toughness, t.after_toughness_max)};
}

ExhibitTable empty_table() {
  constexpr const char* kNew = "prediction error (out-of-sample)";
  constexpr const char* kTrivial = "without structure";
  constexpr const char* kModulus = "error of E, mean (max)";
  constexpr const char* kToughness = "error of T, mean (max)";
  constexpr const char* kBefore = "On the designs that the round is calibrated on, by the model that it began with";
  constexpr const char* kAfter = "On the same designs, by the model calibrated on them";
  return {
      .name = "",
      .columns = {{"", "round", "Rows marked thesis are Table 3.5 of the thesis"},
                  {"", "designs", "How many designs the model of the round is calibrated on"},
                  {"", "E", "Mean relative error of E predicted before the designs were measured", kNew},
                  {"", "T", "Mean relative error of T predicted before the designs were measured", kNew},
                  {"", "rank correlation of T",
                   "Spearman correlation of predicted and measured T, from three designs on; 1: the same order", kNew},
                  {"", "E: straight line",
                   "Error when E is a straight line in the rigid fraction, each design left out in turn", kTrivial},
                  {"", "T: constant", "Error when all patterns have the same, best possible T", kTrivial},
                  {"", "before", kBefore, kModulus},
                  {"", "after", kAfter, kModulus},
                  {"", "before", kBefore, kToughness},
                  {"", "after", kAfter, kToughness}}};
}

}  // namespace

Exhibit error_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "errors", .heading = "Prediction errors"};
  exhibit.notes.push_back(
      "<strong>Out-of-sample</strong>: the model of the previous round predicts its own proposals before they are "
      "measured. These errors say how far the simulation can be trusted. They should be smaller than those of two "
      "predictions that know nothing of structure: E on a straight line in the rigid fraction, and one best T for "
      "all patterns.");
  ExhibitTable table = empty_table();
  for (const auto& [number, round] : run.rounds)
    if (round.summary) table.add(own_row(run, number, *round.summary));
  if (table.rows.empty()) exhibit.notes.push_back(awaited("the end of round 0"));
  for (const ThesisRound& t : kThesisRounds)
    table.add(thesis_row(t, &t == std::end(kThesisRounds) - 1), TableRowKind::thesis);
  exhibit.tables.push_back(std::move(table));
  exhibit.fine_print.push_back(
      "Mean relative errors, in brackets the largest. Out-of-sample errors of the thesis follow from its Tables A.3 "
      "and A.4; its final model ranks T with a correlation of 0.27 on the designs that it was calibrated on.");
  return exhibit;
}

}  // namespace nacre::report
