#include "report/diagnosis_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/statistics.hpp"
#include "diagnosis/gain_words.hpp"
#include "diagnosis/procedure.hpp"
#include "diagnosis/words.hpp"
#include "material/effect_words.hpp"
#include "material/extensions.hpp"
#include "pattern/coupons.hpp"
#include "report/data_exhibit.hpp"
#include "report/diagnosis_figures.hpp"
#include "report/page.hpp"
#include "report/report_diagnosis.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

using diagnosis::CandidateEffect;
using diagnosis::CandidateStatus;
using diagnosis::Diagnosis;
using diagnosis::Verdict;

/// Nothing could be computed (diagnosis::insufficient): only the summary, and the data themselves, say something.
bool nothing_was_weighed(const Diagnosis& d) { return d.verdict == Verdict::insufficient && d.candidates.empty(); }

/// Effects that act together: "a with b".
std::string names_of(const std::vector<std::string>& effects, std::string_view between) {
  std::string names;
  for (const std::string& effect : effects)
    names += fmt::format("{}{}", names.empty() ? "" : between, material::effect_in_words(effect));
  return names;
}

/// Plain.
std::string headline(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::base_sufficient:
      return "Nothing is missing: the residuals are noise";
    case Verdict::named: {
      if (d.finding.reason == diagnosis::Reason::free_form) return "The cause is the strain rate; its law is open";
      std::vector<std::string> effects;
      for (const auto& effect : d.effects) effects.push_back(effect.name);
      return "The cause is " + names_of(effects, " and ");
    }
    case Verdict::ambiguous:
      return "Something is wrong; these data leave several causes";
    case Verdict::insufficient:
      return "Too little was measured to tell";
    case Verdict::unexplained:
      break;
  }
  return "Something is wrong that no known cause explains";
}

/// What the residuals follow.
std::string trend_in_words(const Diagnosis& d) {
  if (d.verdict == Verdict::base_sufficient) {
    return "The residuals, measured less predicted, are of the size of scatter and discretisation error, and follow "
           "nothing that was examined.";
  }
  if (!diagnosis::lines_up(d)) {
    return fmt::format("After the best fit of the base model the residuals follow nothing that was examined{}{}.",
                       d.loudest == diagnosis::RowsOf{} ? "" : "; the largest are those of ",
                       escaped(in_words(d.loudest)));
  }
  const auto& c = d.contrasts.front();
  return fmt::format(
      "After the best fit of the base model the residuals follow most <strong>{}</strong>: by {} standard deviations. "
      "The probability that chance alone does that: {}.",
      escaped(c.name), figure(c.statistic), chance(c.p_family_wise));
}

Exhibit where_exhibit(const Diagnosis& d) {
  Exhibit exhibit{.id = "where", .heading = "Where the simulation is off"};
  exhibit.notes.push_back(trend_in_words(d));
  add_figures(exhibit, residual_figures(d, 6));
  if (FeatureFigure whole = feature_figure(d); !whole.svg.empty()) {
    exhibit.figures.push_back({"", std::move(whole.svg)});
    exhibit.fine_print.push_back("Features of the curve: " + escaped(whole.numbers) + ".");
  }
  exhibit.fine_print.push_back(
      "The strongest trends, with their size in standard deviations (σ). Each mark is one group of replicates; bars "
      "are one standard error, of the replicates and of the discretisation.");
  return exhibit;
}

Exhibit curve_exhibit(const Diagnosis& d) {
  Exhibit exhibit{.id = "curves", .heading = "Curves, measured and simulated"};
  add_figures(exhibit, diagnosis_curve_figures(d, 6));
  exhibit.fine_print.push_back(
      "The groups in which the base model is off most. Simulated curves are those of the nearest parameters that were "
      "run.");
  return exhibit;
}

/// A further number of an effect, after its size.
std::string further_in_words(const material::EffectParameter& parameter, const diagnosis::FittedNumber& number) {
  return fmt::format("With it: <strong>{}{}</strong>, with 90 % certainty between {} and {}. It means: {}.",
                     quantity(number.value), escaped(material::unit_behind_number(parameter.unit)),
                     quantity(number.interval_low), quantity(number.interval_high), escaped(parameter.meaning));
}

/// A named cause: what it is, its size, and what that means.
Exhibit named_part(const diagnosis::NamedEffect& named) {
  Exhibit part{.id = "", .heading = std::string(material::effect_in_words(named.name))};
  const material::Effect* effect = material::find_effect(named.name);
  if (effect != nullptr) part.notes.push_back(escaped(effect->explanation));
  const std::string meaning = effect != nullptr ? escaped(effect->parameters.front().meaning) : "";
  part.notes.push_back(
      fmt::format("Its size: <strong>{}{}</strong>, with 90 % certainty between {} and {}. It means: {}.",
                  quantity(named.parameter), escaped(material::unit_behind_number(named.unit)),
                  quantity(named.interval_low), quantity(named.interval_high), meaning));
  if (effect == nullptr) return part;
  for (std::size_t p = 0; p < named.further.size(); ++p)
    part.notes.push_back(further_in_words(effect->parameters[p + 1], named.further[p]));
  part.notes.push_back(effect->side == material::EffectSide::measurement
                           ? "This is a fault of the measurement, not of the material: it corrects comparisons, but "
                             "designs are not to be chosen by it."
                           : "This is physics of the material or the print: from now on the simulator can include it.");
  return part;
}

Exhibit cause_exhibit(const Diagnosis& d) {
  Exhibit exhibit{.id = "cause", .heading = "The cause"};
  for (const auto& named : d.effects) exhibit.parts.push_back(named_part(named));
  if (d.verdict == Verdict::ambiguous) {
    const std::string common = in_words(d.common_ground);
    exhibit.notes.push_back(fmt::format("Each of these explains the data as well as the others{}:",
                                        common.empty() ? "" : "; common to all of them: " + effect_name(common)));
    for (const auto& model : d.possible) exhibit.list.push_back(escaped(names_of(model, " with ")));
  }
  if (d.verdict == Verdict::unexplained) {
    exhibit.notes.push_back(
        "No cause is named; the sentence above says why. The simulation should not be extended by the nearest one: it "
        "may predict better for the wrong reason.");
    if (d.partial_gain) exhibit.notes.push_back("Of the nearest: " + escaped(gain_in_words(*d.partial_gain)));
  }
  if (exhibit.notes.empty() && exhibit.parts.empty()) exhibit.notes.push_back("No cause is needed.");
  return exhibit;
}

/// The status of a candidate effect and why.
std::string status_cell(const CandidateEffect& c, Verdict verdict) {
  const std::string status = escaped(status_in_words(to_string(c.status), c.p_family_wise));
  if (c.status == CandidateStatus::in_set) return fmt::format("<strong>{}</strong>", status);
  if (c.status == CandidateStatus::invisible || c.status == CandidateStatus::not_simulated)
    return status + " (it may act all the same)";
  if (c.status != CandidateStatus::excluded) return status + " (these tests cannot show it)";
  if (c.p_family_wise > diagnosis::Levels{}.name) return status;
  return status + (verdict == Verdict::unexplained ? " (improves the fit, not enough)"
                                                   : " (improves the fit, others explain the data better)");
}

constexpr const char* kCandidateColumns =
    "SNR: what refitted base parameters leave of the effect's signature, in standard errors, at its fitted size, or at "
    "a typical one where nothing was found (a named effect is judged once more at parameters of its own). Below {:.1f} "
    "it is not visible. Visible from: the size that these specimens would have shown; a smaller one may act. "
    "Collinearity 1: these specimens cannot tell the two effects apart. Chance: probability that the best of all "
    "candidates does as well by accident.";

/// From which size on an effect would have shown: "0.31 pixels".
std::string visible_from(const CandidateEffect& c) {
  if (!c.smallest_seen) return "–";
  const std::string_view unit = material::find_effect(c.name)->parameters.front().unit;
  return quantity(*c.smallest_seen) + escaped(material::unit_behind_number(unit));
}

ExhibitTable candidate_table(const Diagnosis& d) {
  ExhibitTable table{
      .name = "",
      .columns = {{"", "candidate effect"},
                  {"", "status"},
                  {"", "SNR", "Signal-to-noise ratio: how visible the effect is in these data"},
                  {"", "imitated by base model", "Share of its signature that refitted base parameters imitate"},
                  {"", "visible from", "The size from which on these specimens would have shown it"},
                  {"", "most similar effect (collinearity)", "1: no data of this kind tell the two apart"},
                  {"", "improvement of fit (chi squared)",
                   "How much chi squared falls when the effect joins the refitted base model"},
                  {"", "chance", "Probability that the best of all candidates does as well by accident"}}};
  table.look = "words wrapped";
  for (const CandidateEffect& c : d.candidates) {
    const bool acts = diagnosis::was_weighed(c.status);
    table.add({shown_cell(effect_name(c.name)), shown_cell(status_cell(c, d.verdict)),
               shown_cell(acts ? figure(c.signal_to_noise) : "–"), shown_cell(acts ? percent(c.absorption) : "–"),
               shown_cell(visible_from(c)),
               shown_cell(c.nearest_rival.empty()
                              ? "–"
                              : fmt::format("{} ({})", effect_name(c.nearest_rival), figure(c.rival_cosine))),
               shown_cell(acts ? figure(c.statistic) : "–"), shown_cell(acts ? chance(c.p_family_wise) : "–")});
  }
  return table;
}

Exhibit candidate_exhibit(const Diagnosis& d) {
  Exhibit exhibit{.id = "rivals", .heading = "Candidate effects: what else could explain it"};
  exhibit.tables.push_back(candidate_table(d));
  exhibit.fine_print.push_back(fmt::format(kCandidateColumns, diagnosis::NameRules{}.visible_signal));
  return exhibit;
}

Exhibit gain_exhibit(const diagnosis::Gain& gain) {
  Exhibit exhibit{.id = "gain", .heading = "What the extended model gains"};
  exhibit.notes.push_back(escaped(gain_in_words(gain) + choice_in_words(gain)));
  ExhibitTable table{.name = "",
                     .columns = {{"", "mean error on held-out designs", "Designs kept out of the fit, in turn"},
                                 {"", "unit"},
                                 {"", "base model"},
                                 {"", "extended model"},
                                 {"", "noise alone", "Error that scatter and discretisation leave of any model"}}};
  for (const auto& g : gain.features)
    table.add({text_cell(in_words(g.feature)), text_cell(shown_unit(g.feature)),
               shown_cell(figure(shown(g.feature, g.before))), shown_cell(figure(shown(g.feature, g.after))),
               shown_cell(figure(shown(g.feature, g.noise)))});
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

/// Why no test is proposed.
std::string why_no_test(const Diagnosis& d) {
  const auto invisible = std::ranges::count(d.candidates, CandidateStatus::invisible, &CandidateEffect::status);
  if (d.verdict != Verdict::base_sufficient || invisible == 0)
    return "No two models are left that another specimen would tell apart.";
  return fmt::format(
      "{} of the effects above {} not visible on these specimens and may act all the same. "
      "<code>nacre diagnose SET --plan</code> says which specimens would show {}.",
      invisible, invisible == 1 ? "is" : "are", invisible == 1 ? "it" : "them");
}

Exhibit next_exhibit(const Diagnosis& d) {
  Exhibit exhibit{.id = "next", .heading = "The next test"};
  for (const auto& e : d.next_experiments) {
    exhibit.list.push_back(fmt::format(
        "<strong>{}</strong> of {} at {:.0f} degrees, {:.3g} /s, {} mm{}, {} specimens; {}.", tester::to_string(e.test),
        design_name(pattern::readable_name(e.design)), e.conditions.orientation_deg, e.conditions.strain_rate_per_s,
        e.conditions.thickness_mm, escaped(surroundings_in_words(e)), e.replicates, escaped(e.reason)));
  }
  if (exhibit.list.empty()) exhibit.notes.push_back(why_no_test(d));
  return exhibit;
}

/// How well means are known.
std::string noise_in_words(const Diagnosis& d) {
  std::string words = d.noise_known ? fmt::format("Replicates scatter by {}", percent(d.replicate_sd))
                                    : fmt::format("A scatter of {} is assumed", percent(d.replicate_sd));
  const auto error_of = [&](diagnosis::Feature feature) {
    std::vector<double> errors;
    for (const diagnosis::ResidualRow& row : d.residuals)
      if (row.feature == feature) errors.push_back(row.standard_error);
    return errors.empty() ? 0.0 : quantile(errors, 0.5);
  };
  if (const double error = error_of(diagnosis::Feature::log_modulus); error > 0.0)
    words += fmt::format(
        "; the discretisation leaves an error of {} in the modulus of a layout and {} that all layouts share; a "
        "design's mean is known to {} but for the shared part",
        percent(d.discretisation_sd), percent(d.discretisation_shared_sd), percent(error));
  if (const double error = error_of(diagnosis::Feature::log_toughness); error > 0.0)
    words +=
        fmt::format("; a design's toughness is known to a factor of {:.2f}, replicates and discretisation together",
                    std::exp(error));
  return words + ".";
}

Exhibit method_exhibit(const Diagnosis& d, tester::Fidelity fidelity) {
  Exhibit exhibit{.id = "method", .heading = "How it was computed"};
  exhibit.notes.push_back(noise_in_words(d));
  exhibit.notes.push_back(fmt::format("Fidelity {}; {} fracture simulations. Procedure {}.",
                                      tester::to_string(fidelity), d.simulations, escaped(d.procedure)));
  return exhibit;
}

/// All that was found, and how.
std::vector<Exhibit> findings(const Diagnosis& d, tester::Fidelity fidelity) {
  std::vector<Exhibit> exhibits;
  if (shows_data(d.data)) exhibits.push_back(data_exhibit(d.data));
  if (nothing_was_weighed(d)) return exhibits;
  exhibits.push_back(where_exhibit(d));
  if (!d.curves.empty()) exhibits.push_back(curve_exhibit(d));
  exhibits.push_back(cause_exhibit(d));
  exhibits.push_back(candidate_exhibit(d));
  if (d.gain) exhibits.push_back(gain_exhibit(*d.gain));
  exhibits.push_back(next_exhibit(d));
  exhibits.push_back(method_exhibit(d, fidelity));
  return exhibits;
}

}  // namespace

std::string render_diagnosis_page(const Diagnosis& d, const std::string& set, tester::Fidelity fidelity) {
  const std::string title = "Diagnosis of " + set;
  std::string content = paragraph(escaped(d.summary), "standing");
  if (!d.noise_known)
    content += paragraph(
        "Where there are no replicates a scatter of 2 % is assumed: what is said of those tests depends on it.",
        "warning");
  if (fidelity == tester::Fidelity::tiny)
    content += paragraph(
        "Fidelity <code>tiny</code>: specimens of a single unit, for tests of the program. The figures mean nothing.",
        "warning");
  return render_page({.title = title, .eyebrow = title, .heading = headline(d), .content = content},
                     findings(d, fidelity));
}

}  // namespace nacre::report
