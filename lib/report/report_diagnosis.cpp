// What the diagnosis of each round says.

#include <fmt/format.h>

#include "material/effect_words.hpp"
#include "report/report_sections.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"
#include "store/misfit.hpp"

namespace nacre::report {
namespace {

std::string effect_table(const std::vector<store::RecordedEffect>& effects) {
  if (effects.empty()) return "";
  std::string rows;
  for (const store::RecordedEffect& e : effects) {
    rows += table_row({effect_name(e.name), quantity(e.parameter),
                       fmt::format("{} … {}", quantity(e.interval_low), quantity(e.interval_high)), escaped(e.unit)});
  }
  return table(header_row({"named effect", "size", "90 % interval", "unit"}), rows);
}

std::string status_in_words(const std::string& status) {
  if (status == "in_set") return "<strong>explains the misfit</strong>";
  if (status == "excluded") return "excluded";
  if (status == "invisible") return "invisible to these specimens";
  if (status == "not_applicable") return "not applicable";
  return escaped(status);
}

std::string candidate_table(const std::vector<store::RecordedCandidate>& candidates) {
  if (candidates.empty()) return "";
  std::string rows;
  for (const store::RecordedCandidate& c : candidates) {
    const bool took_part = c.status != "not_applicable";
    rows += table_row({effect_name(c.name), status_in_words(c.status), took_part ? figure(c.statistic) : "–",
                       took_part ? chance(c.p_family_wise) : "–", took_part ? percent(c.absorption) : "–"});
  }
  return table(header_row({"candidate", "status", "drop of χ²", "p (family-wise)", "absorbed by the base"}), rows);
}

/// A verdict that the calibration of the same round speaks against does not stand alone.
std::string disagreement(const store::RoundRecord& round) {
  const std::string words = store::misfit_beside_verdict(round);
  return words.empty() ? "" : paragraph(escaped(words), "warning");
}

}  // namespace

std::string verdict_in_words(const std::string& verdict) {
  if (verdict == "base_sufficient") return "the base model is sufficient";
  if (verdict == "named") return "a cause is named";
  if (verdict == "ambiguous") return "ambiguous, these data cannot tell yet";
  if (verdict == "unexplained") return "something is wrong that no known effect explains";
  return escaped(verdict);
}

std::string diagnosis_section(const store::RunRecord& run) {
  constexpr std::string_view kHeading = "Diagnosis: what the simulation gets wrong, and why";
  std::string content;
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (!round->second.diagnosis) continue;
    const store::RecordedDiagnosis& d = *round->second.diagnosis;
    // The summary says what a named effect gains on held-out designs (diagnosis::gain_in_words): no second figure here.
    content += fmt::format("<h3>Round {}: {}</h3>\n", round->first, verdict_in_words(d.verdict)) +
               paragraph(escaped(d.summary)) + disagreement(round->second) + effect_table(d.effects) +
               candidate_table(d.candidates);
  }
  if (content.empty())
    return section(
        "diagnosis", kHeading,
        awaited("the first diagnosis, which follows the calibration of round 1 (unless the scenario turns it off)"));
  return section(
      "diagnosis", kHeading,
      content +
          paragraph(
              "Drop of χ²: how much better the measured moduli fit when the effect joins the refitted base model. p: "
              "chance of the best candidate doing as well when "
              "the base model is true. Absorbed: the share of the effect's signature that the base parameters imitate.",
              "quiet"));
}

}  // namespace nacre::report
