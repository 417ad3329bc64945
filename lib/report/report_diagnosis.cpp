#include "report/report_diagnosis.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/procedure.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"
#include "run/misfit.hpp"

namespace nacre::report {
namespace {

ExhibitTable effect_table(const std::vector<wire::DiagnosedEffect>& effects) {
  ExhibitTable table{.name = "",
                     .columns = {{"", "cause"},
                                 {"", "effect size", "Fitted value of the parameter that the cause adds to the model"},
                                 {"", "90 % interval", "Holds the true value in nine of ten cases"},
                                 {"", "unit"}}};
  for (const wire::DiagnosedEffect& e : effects) {
    table.add({shown_cell(effect_name(e.name)), shown_cell(quantity(e.parameter)),
               shown_cell(fmt::format("{} … {}", quantity(e.interval_low), quantity(e.interval_high))),
               text_cell(e.unit)});
  }
  return table;
}

ExhibitTable candidate_table(const std::vector<wire::DiagnosedCandidate>& candidates) {
  ExhibitTable table{
      .name = "",
      .columns = {
          {"", "candidate effect"},
          {"", "status",
           "explains it: with this effect the model agrees with the measurements. does not explain it: the fit "
           "improves, but other effects explain more, or none enough. no sign of it: it would have shown. these tests "
           "cannot say: it may act, these specimens would not show it. not simulated: it may act, and too few "
           "simulations were paid for to tell"},
          {"", "improvement of fit (chi squared)",
           "How much chi squared falls when the effect joins the refitted base model"},
          {"", "chance", "Probability that the best of all candidates does as well when the base model is true"},
          {"", "imitated by base model", "Share of the effect's signature that refitted base parameters imitate"}}};
  table.look = "named";
  for (const wire::DiagnosedCandidate& c : candidates) {
    const bool was_fitted = c.status != "not_applicable" && c.status != "not_simulated";
    const std::string status = escaped(status_in_words(c.status, c.p_family_wise));
    table.add({shown_cell(effect_name(c.name)),
               shown_cell(c.status == "in_set" ? fmt::format("<strong>{}</strong>", status) : status),
               shown_cell(was_fitted ? figure(c.statistic) : "–"),
               shown_cell(was_fitted ? chance(c.p_family_wise) : "–"),
               shown_cell(was_fitted ? percent(c.absorption) : "–")});
  }
  return table;
}

/// Beside the answers of the rounds.
Exhibit revealed_part(const wire::Reveal& reveal) {
  Exhibit part{.id = "", .heading = "What the laboratory had hidden"};
  if (reveal.causes.empty())
    part.notes.push_back("Nothing: its measurements differ from the base model by noise alone.");
  ExhibitTable table{.name = "",
                     .columns = {{"", "hidden cause"}, {"", "value"}, {"", "meaning"}, {"", "known to the diagnosis"}}};
  table.look = "words";
  for (const wire::HiddenCause& cause : reveal.causes) {
    std::string values;
    for (const double value : cause.values) values += (values.empty() ? "" : ", ") + quantity(value);
    table.add({shown_cell(effect_name(cause.name)), shown_cell(values), text_cell(cause.meaning),
               text_cell(cause.in_library ? "yes" : "no: the honest answer is that something is unexplained")});
  }
  if (!reveal.causes.empty()) part.tables.push_back(std::move(table));
  part.fine_print.push_back(fmt::format("Noise between its replicates: E {}, T {}.", percent(reveal.modulus_noise),
                                        percent(reveal.toughness_noise)));
  return part;
}

}  // namespace

std::string verdict_in_words(const std::string& verdict) {
  if (verdict == "base_sufficient") return "the base model is sufficient";
  if (verdict == "named") return "a cause is named";
  if (verdict == "ambiguous") return "several causes are possible, more tests are needed";
  if (verdict == "insufficient") return "too little was measured to tell";
  if (verdict == "unexplained") return "something is wrong that no known effect explains";
  return verdict;
}

std::string status_in_words(std::string_view status, double p_family_wise) {
  if (status == "in_set") return "explains it";
  if (status == "excluded") return p_family_wise <= diagnosis::Levels{}.name ? "does not explain it" : "no sign of it";
  if (status == "not_simulated") return "not simulated";
  if (status == "invisible" || status == "not_applicable") return "these tests cannot say";
  return std::string(status);
}

Exhibit diagnosis_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "diagnosis", .heading = "Diagnosis: what the simulation gets wrong, and why"};
  if (run.revealed) exhibit.parts.push_back(revealed_part(*run.revealed));
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (!round->second.diagnosis) continue;
    const wire::Diagnosis& d = *round->second.diagnosis;
    // The summary says what a named effect gains on new designs (diagnosis::gain_in_words): no second figure here.
    // A verdict that the calibration of the same round speaks against does not stand alone.
    const std::string against = run::misfit_beside_verdict(round->second);
    const std::string verdict = against.empty() ? verdict_in_words(d.verdict)
                                                : "nothing is found missing, and yet the calibration does not fit";
    Exhibit part{.id = "", .heading = fmt::format("Round {}: {}", round->first, verdict)};
    part.notes.push_back(escaped(d.summary));
    if (!against.empty()) part.warnings.push_back(escaped(against));
    part.tables = {effect_table(run::named_effects(d)), candidate_table(d.candidates)};
    exhibit.parts.push_back(std::move(part));
  }
  const bool is_answered =
      std::ranges::any_of(run.rounds, [](const auto& each) { return each.second.diagnosis.has_value(); });
  if (!is_answered)
    exhibit.notes.push_back(run.is_diagnosed ? awaited("the first diagnosis, which follows the calibration of round 1")
                                             : "The scenario turns the diagnosis off.");
  return exhibit;
}

}  // namespace nacre::report
