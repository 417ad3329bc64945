#include "report/report_designs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/design_picture.hpp"
#include "report/report_data.hpp"
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

/// With the scatter of specimens, as measured values have it; their number and the mean's standard error as a hint.
Cell predicted_toughness(const wire::ProposedDesign& proposal) {
  if (proposal.specimens < 2) return mpa_cell(proposal.toughness_pa);
  return shown_cell(fmt::format("<span title=\"mean of {} specimens, standard error {} MPa\">{}</span>",
                                proposal.specimens,
                                figure(proposal.toughness_sd_pa * 1e-6 / std::sqrt(proposal.specimens)),
                                with_error(proposal.toughness_pa * 1e-6, proposal.toughness_sd_pa * 1e-6)));
}

/// Predicted and measured E and T; `missing`: what stands for measured values where there are none.
std::string performance_table(const wire::ProposedDesign& proposal, const MeasuredPattern* measured,
                              const std::string& missing) {
  ExhibitTable table{.name = "", .columns = {{"", ""}, {"", "E (GPa)"}, {"", "T (MPa)"}}};
  table.add({text_cell("predicted"), gpa_cell(proposal.modulus_pa), predicted_toughness(proposal)});
  if (measured != nullptr) {
    table.add({text_cell("measured"),
               shown_cell(with_error(measured->mean.modulus_pa * 1e-9, measured->modulus_sd_pa * 1e-9)),
               shown_cell(with_error(measured->mean.toughness_pa * 1e-6, measured->toughness_sd_pa * 1e-6))});
    table.add({text_cell("prediction error"), shown_cell(deviation(proposal.modulus_pa, measured->mean.modulus_pa)),
               shown_cell(deviation(proposal.toughness_pa, measured->mean.toughness_pa))});
  } else {
    table.add({text_cell("measured"), text_cell(missing), text_cell(missing)}, TableRowKind::aside);
  }
  return html_of(table);
}

ExhibitFigure proposal_card(const wire::ProposedDesign& proposal, const std::vector<MeasuredPattern>& measured,
                            const std::string& missing) {
  constexpr int kPictureOfProposal = 120;  // px
  const std::string name = proposal.design.name();
  return {.name = "",
          .svg = design_picture(proposal.design, kPictureOfProposal),
          .caption = fmt::format("<p>{}</p>\n{}<p class=\"quiet\">{}</p>", design_name(name),
                                 performance_table(proposal, find_measured(measured, name), missing),
                                 escaped(proposal.reason))};
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

/// With who amended the specimen and why.
std::string note_of(const run::MeasuredSpecimen& m) {
  if (m.amendment.revision == 0) return m.record.note;
  return fmt::format("{}{}amended by {}: {}", m.record.note, m.record.note.empty() ? "" : "; ", m.amendment.by,
                     m.amendment.why);
}

std::vector<Cell> specimen_row(const run::MeasuredSpecimen& m) {
  const measurement::SpecimenRecord& r = m.record;
  const auto modulus = measurement::modulus_of(r),
             toughness = r.test == tester::TestKind::toughness ? measurement::toughness_of(r) : r.toughness_pa;
  return {shown_cell(specimen_name(r.specimen)),
          shown_cell(m.round < 0 ? "–" : fmt::format("{}", m.round)),
          shown_cell(design_name(r.design.name())),
          text_cell(test_name(r.test)),
          gpa_cell(modulus),
          mpa_cell(toughness),
          text_cell(conditions_of(r)),
          text_cell(r.batch),
          shown_cell(r.valid ? "valid" : "<strong class=\"bad\">invalid</strong>"),
          shown_cell(fmt::format("<span>{}</span>", escaped(note_of(m))))};
}

}  // namespace

Exhibit proposal_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "proposals", .heading = "Proposed patterns"};
  const auto measured = measured_patterns(run, newest_round(run).value_or(0));
  const std::string missing = is_over(run) ? "not measured" : "awaited";
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (round->second.proposals.empty()) continue;
    Exhibit& part = exhibit.parts.emplace_back(Exhibit{.id = "", .heading = fmt::format("Round {}", round->first)});
    for (const wire::ProposedDesign& proposal : round->second.proposals)
      part.figures.push_back(proposal_card(proposal, measured, missing));
  }
  exhibit.notes.push_back(
      exhibit.parts.empty()
          ? awaited("the first proposal")
          : fmt::format("One unit of 20 × 20 pixels each: {}. A pattern was chosen by its predicted values, which are "
                        "those of the material without the testing machine; the sentence below them says why.",
                        phase_legend()));
  return exhibit;
}

Exhibit specimen_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "specimens", .heading = "Specimens"};
  if (run.specimens.empty()) {
    exhibit.notes.push_back(awaited("the first measurement"));
    return exhibit;
  }
  ExhibitTable table{.name = "",
                     .columns = {{"", "specimen"},
                                 {"", "round", "That it was ordered in; –: nobody ordered it"},
                                 {"", "design", "Key of a pattern, or a homogeneous material"},
                                 {"", "test", "modulus: a plain bar; toughness: a notched specimen"},
                                 {"", "E (GPa)", "Young's modulus"},
                                 {"", "T (MPa)", "Toughness: area under the curve until the specimen separates"},
                                 {"", "conditions", "Orientation, strain rate, thickness"},
                                 {"", "batch", "Specimens printed together"},
                                 {"", "validity", "As reviewed"},
                                 {"", "note"}}};
  table.look = "words";
  int invalid = 0;
  for (const run::MeasuredSpecimen& m : run.specimens) {
    table.add(specimen_row(m), m.record.valid ? TableRowKind::own : TableRowKind::aside);
    if (!m.record.valid) ++invalid;
  }
  exhibit.notes.push_back(
      fmt::format("{} {}, {} of them invalid. Invalid ones are shown, but count nowhere. Standard conditions: {}.",
                  run.specimens.size(), run.specimens.size() == 1 ? "specimen" : "specimens", invalid, in_words({})));
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

}  // namespace nacre::report
