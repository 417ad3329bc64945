// The proposed patterns, round by round; the specimens.

#include <fmt/format.h>

#include "report/report_data.hpp"
#include "report/report_figures.hpp"
#include "report/report_sections.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

/// "+12.0 %": how far the prediction lies above the measurement.
std::string deviation(double predicted, double measured) {
  if (!(measured > 0.0)) return "–";
  const double share = predicted / measured - 1.0;
  return share > 0.0 ? "+" + percent(share) : percent(share);
}

/// `missing`: what stands for measured values where there are none.
std::string performance_table(const store::RecordedProposal& proposal, const MeasuredPattern* measured,
                              const std::string& missing) {
  const optimize::Performance& p = proposal.predicted;
  std::string rows = table_row({"predicted", gpa(p.modulus_pa), mpa(p.toughness_pa)});
  if (measured != nullptr) {
    rows += table_row({"measured", with_error(measured->mean.modulus_pa * 1e-9, measured->modulus_sd_pa * 1e-9),
                       with_error(measured->mean.toughness_pa * 1e-6, measured->toughness_sd_pa * 1e-6)});
    rows += table_row({"off by", deviation(p.modulus_pa, measured->mean.modulus_pa),
                       deviation(p.toughness_pa, measured->mean.toughness_pa)});
  } else {
    rows += table_row({"measured", missing, missing}, "reference");
  }
  return "<table><thead>" + header_row({"", "E (GPa)", "T (MPa)"}) + "</thead><tbody>" + rows + "</tbody></table>\n";
}

std::string proposal_card(const store::RecordedProposal& proposal, const std::vector<MeasuredPattern>& measured,
                          const std::string& missing) {
  const auto design = pattern::design_from_name(proposal.design);
  const std::string picture = design ? design_picture(*design, 120) : "";
  return fmt::format("<div class=\"card\">{}<div><p>{}</p>\n{}<p class=\"quiet\">{}</p></div></div>\n", picture,
                     design_name(proposal.design),
                     performance_table(proposal, find_measured(measured, proposal.design), missing),
                     escaped(proposal.reason));
}

std::string in_words(const tester::TestConditions& c) {
  return fmt::format("{:.0f}°, {} /s, {:.2f} mm", c.orientation_deg, quantity(c.strain_rate_per_s), c.thickness_mm);
}

std::string conditions_of(const measurement::SpecimenRecord& r) {
  return r.conditions == tester::TestConditions{} ? "standard" : in_words(r.conditions);
}

std::string test_name(tester::TestKind test) { return std::string(tester::to_string(test)); }

std::string specimen_name(const std::string& name) {
  constexpr std::size_t kOneLine = 36;
  return fmt::format("<code{}>{}</code>", name.size() > kOneLine ? " class=\"long\"" : "", escaped(name));
}

std::string specimen_row(const store::MeasuredSpecimen& m) {
  const measurement::SpecimenRecord& r = m.record;
  const auto modulus = measurement::modulus_of(r),
             toughness = r.test == tester::TestKind::toughness ? measurement::toughness_of(r) : r.toughness_pa;
  const std::string validity = r.valid ? "valid" : "<strong class=\"bad\">invalid</strong>";
  return table_row(
      {specimen_name(r.specimen), m.round < 0 ? "–" : fmt::format("{}", m.round), design_name(r.design.name()),
       test_name(r.test), modulus ? gpa(*modulus) : "–", toughness ? mpa(*toughness) : "–", conditions_of(r),
       escaped(r.batch), validity, fmt::format("<span>{}</span>", escaped(r.note))},
      r.valid ? "" : "invalid");
}

}  // namespace

std::string proposal_section(const store::RunRecord& run) {
  constexpr std::string_view kHeading = "Proposed patterns";
  const auto measured = measured_patterns(run, newest_round(run).value_or(0));
  const std::string missing = is_over(run) ? "not measured" : "awaited";
  std::string content;
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (round->second.proposals.empty()) continue;
    content += fmt::format("<h3>Round {}</h3>\n<div class=\"cards\">\n", round->first);
    for (const store::RecordedProposal& proposal : round->second.proposals)
      content += proposal_card(proposal, measured, missing);
    content += "</div>\n";
  }
  if (content.empty()) return section("proposals", kHeading, awaited("the first proposal"));
  return section("proposals", kHeading,
                 paragraph("Rigid pixels dark, soft ones light; one unit of 20 × 20. Predictions are those the pattern "
                           "was chosen by, of the material without the "
                           "testing machine.") +
                     content);
}

std::string specimen_section(const store::RunRecord& run) {
  constexpr std::string_view kHeading = "Specimens";
  if (run.specimens.empty()) return section("specimens", kHeading, awaited("the first measurement"));
  int invalid = 0;
  std::string rows;
  for (const store::MeasuredSpecimen& m : run.specimens) {
    rows += specimen_row(m);
    if (!m.record.valid) ++invalid;
  }
  const std::string count = fmt::format(
      "{} specimens, {} of them invalid. Validity as reviewed; invalid ones count nowhere but are shown. Standard "
      "conditions: {}.",
      run.specimens.size(), invalid, in_words({}));
  return section("specimens", kHeading,
                 paragraph(count) + table(header_row({"specimen", "round", "design", "test", "E (GPa)", "T (MPa)",
                                                      "conditions", "batch", "validity", "note"}),
                                          rows, "words"));
}

}  // namespace nacre::report
