#include "report/diagnosis_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/statistics.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/settings.hpp"
#include "material/effect_words.hpp"
#include "material/extensions.hpp"
#include "pattern/coupons.hpp"
#include "report/diagnosis_figures.hpp"
#include "report/report_sections.hpp"
#include "report/report_style.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

using diagnosis::CandidateEffect;
using diagnosis::Diagnosis;
using diagnosis::Verdict;

/// Too few data (diagnosis::undecided): nothing was weighed, only the summary says something.
bool is_undecided(const Diagnosis& d) {
  return d.verdict == Verdict::ambiguous && d.possible.empty() && d.candidates.empty();
}

std::string headline(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::base_sufficient:
      return "Nothing is wrong beyond noise";
    case Verdict::named: {
      std::string names;
      for (const auto& effect : d.effects) names += (names.empty() ? "" : " and ") + effect_name(effect.name);
      return "The cause is " + names;
    }
    case Verdict::ambiguous:
      return is_undecided(d) ? "These data cannot tell yet" : "Something is wrong; these data leave several causes";
    case Verdict::unexplained:
      break;
  }
  return "Something is wrong that no known cause explains";
}

std::string figures(const std::vector<std::string>& svgs) {
  std::string html = "<div class=\"figures\">\n";
  for (const std::string& svg : svgs) html += svg;
  return html + "</div>\n";
}

std::string where_section(const Diagnosis& d) {
  std::string content;
  if (d.verdict == Verdict::base_sufficient) {
    content += paragraph(
        "What is left between measurement and simulation is of the size of scatter and numerics, and lines up with "
        "nothing.");
  } else if (!diagnosis::lines_up(d)) {
    content += paragraph(
        fmt::format("What is left after the best fit of the base model lines up with nothing that was looked for{}{}.",
                    d.loudest.empty() ? "" : "; the largest residuals are those of ", escaped(d.loudest)));
  } else {
    const auto& c = d.contrasts.front();
    content += paragraph(
        fmt::format("What is left after the best fit of the base model lines up most with <strong>{}</strong>: {} "
                    "standard deviations, where chance alone gives as much in a share {} of cases.",
                    escaped(c.name), figure(c.statistic), chance(c.p_family_wise)));
  }
  std::vector<std::string> pictures = residual_figures(d, 6);
  if (const std::string whole = feature_figure(d); !whole.empty()) pictures.push_back(whole);
  content += figures(pictures);
  content += paragraph(
      "Pictures of the strongest trends, with their size in standard deviations (σ). Each mark is one group of "
      "replicates; bars are one standard error, from the replicates and from what the "
      "simulation's own elements leave open.",
      "quiet");
  return section("where", "Where the simulation is off", content);
}

std::string curve_part(const Diagnosis& d) {
  if (d.curves.empty()) return "";
  return section(
      "curves", "Curves, measured and simulated",
      figures(diagnosis_curve_figures(d, 6)) + paragraph("The groups in which the base model is off most. Simulated "
                                                         "curves are those of the nearest parameters that were run.",
                                                         "quiet"));
}

/// A number that an effect takes beside its size.
std::string further_in_words(const material::EffectParameter& parameter, const diagnosis::FittedNumber& number) {
  return fmt::format("With it: <strong>{}{}</strong>, with 90 % certainty between {} and {}. It means: {}.",
                     quantity(number.value), escaped(material::unit_behind_number(parameter.unit)),
                     quantity(number.interval_low), quantity(number.interval_high), escaped(parameter.meaning));
}

std::string cause_section(const Diagnosis& d) {
  std::string content;
  for (const auto& named : d.effects) {
    const material::Effect* effect = material::find_effect(named.name);
    content += fmt::format("<h3>{}</h3>\n", effect_name(named.name));
    if (effect != nullptr) content += paragraph(escaped(effect->explanation));
    const std::string meaning = effect != nullptr ? escaped(effect->parameters.front().meaning) : "";
    content +=
        paragraph(fmt::format("Its size: <strong>{}{}</strong>, with 90 % certainty between {} and {}. It means: {}.",
                              quantity(named.parameter), escaped(material::unit_behind_number(named.unit)),
                              quantity(named.interval_low), quantity(named.interval_high), meaning));
    for (std::size_t p = 0; effect != nullptr && p < named.further.size(); ++p)
      content += paragraph(further_in_words(effect->parameters[p + 1], named.further[p]));
    if (effect != nullptr)
      content +=
          paragraph(effect->side == material::EffectSide::measurement
                        ? "This is a fault of the measurement, not of the material: it corrects comparisons, designs "
                          "are not to be chosen by it."
                        : "This is physics of the material or the print: from now on the simulator can carry it.");
  }
  if (d.verdict == Verdict::ambiguous) {
    std::string list;
    for (const auto& model : d.possible) {
      std::string names;
      for (const std::string& name : model) names += (names.empty() ? "" : " with ") + effect_name(name);
      list += fmt::format("<li>{}</li>\n", names);
    }
    content += paragraph("Each of these explains the data as well as the others:") + "<ul>" + list + "</ul>\n";
    if (!d.common_ground.empty()) content += paragraph("Common to all of them: " + effect_name(d.common_ground) + ".");
  }
  if (d.verdict == Verdict::unexplained) {
    content += paragraph(
        "No cause is named; the sentence above says why. The simulation should not be extended by the one that comes "
        "nearest: it may predict better for the wrong reason.");
    if (d.partial_gain) content += paragraph("Of the nearest: " + escaped(gain_in_words(*d.partial_gain)));
  }
  if (content.empty()) content = paragraph("No cause is needed.");
  return section("cause", "The cause", content);
}

std::string status_words(const CandidateEffect& c, Verdict verdict) {
  if (c.status == "in_set") return "<strong>explains it</strong>";
  const char* helps =
      verdict == Verdict::unexplained ? "helps, but cannot be named" : "helps, but others explain it better";
  if (c.status == "excluded")
    return c.p_family_wise <= diagnosis::DiagnosisSettings{}.name_level ? helps : "no sign of it";
  if (c.status == "invisible") return "invisible on these data (not: absent)";
  return "these tests cannot say";
}

constexpr const char* kColumnsOfRivals =
    "Signal / noise: of the cause at its fitted size, or at a typical size where nothing was found, counted where the "
    "base model stands (a name is judged once more at constants of its own); below {:.1f} it cannot be told from "
    "nothing. Hidden by the base: share of its traces that other constants of the materials "
    "imitate. Seen from: the size whose traces these specimens would have shown; a smaller one may be there. Cosine 1: "
    "two causes look alike on these specimens. Chance: how often the best of all causes would look "
    "as good by accident.";

/// From which size on an effect would have shown: "0.31 pixels".
std::string seen_from(const CandidateEffect& c) {
  if (!c.smallest_seen) return "–";
  const std::string_view unit = material::find_effect(c.name)->parameters.front().unit;
  return quantity(*c.smallest_seen) + escaped(material::unit_behind_number(unit));
}

std::string rivals_section(const Diagnosis& d) {
  std::string rows;
  for (const CandidateEffect& c : d.candidates) {
    const bool acts = c.status != "not_applicable";
    rows += table_row(
        {effect_name(c.name), status_words(c, d.verdict), acts ? figure(c.signal_to_noise) : "–",
         acts ? percent(c.absorption) : "–", seen_from(c),
         c.nearest_rival.empty() ? "–" : fmt::format("{} ({})", effect_name(c.nearest_rival), figure(c.rival_cosine)),
         acts ? figure(c.statistic) : "–", acts ? chance(c.p_family_wise) : "–"});
  }
  return section("rivals", "What else could explain it",
                 table(header_row({"cause", "judgement", "signal / noise", "hidden by the base", "seen from",
                                   "most like (cosine)", "drop of χ²", "chance"}),
                       rows, "words wrapped") +
                     paragraph(fmt::format(kColumnsOfRivals, diagnosis::kVisibleSignal), "quiet"));
}

std::string gain_section(const Diagnosis& d) {
  if (!d.gain) return "";
  std::string rows;
  for (const auto& g : d.gain->features)
    rows += table_row({std::string(in_words(g.feature)), std::string(shown_unit(g.feature)),
                       figure(shown(g.feature, g.before)), figure(shown(g.feature, g.after)),
                       figure(shown(g.feature, g.noise))});
  return section(
      "gain", "What the extended model gains",
      paragraph(escaped(gain_in_words(*d.gain) + choice_in_words(*d.gain))) +
          table(header_row({"mean error on held-out designs", "unit", "base", "extended", "noise alone"}), rows));
}

/// Why no test is proposed.
std::string nothing_asked_for(const Diagnosis& d) {
  const auto invisible = std::count_if(d.candidates.begin(), d.candidates.end(),
                                       [](const CandidateEffect& c) { return c.status == "invisible"; });
  if (d.verdict != diagnosis::Verdict::base_sufficient || invisible == 0)
    return "No two models are left that another specimen would tell apart.";
  return fmt::format(
      "{} of the causes above would leave nothing visible on these specimens: they are not absent. "
      "<code>nacre diagnose SET --plan</code> says which specimens would show them.",
      invisible);
}

std::string next_section(const Diagnosis& d) {
  std::string list;
  for (const auto& e : d.next_experiments) {
    list += fmt::format("<li><strong>{}</strong> of {} at {:.0f} degrees, {:.3g} /s, {} mm, {} specimens; {}.</li>\n",
                        tester::to_string(e.test), design_name(pattern::readable_name(e.design)),
                        e.conditions.orientation_deg, e.conditions.strain_rate_per_s, e.conditions.thickness_mm,
                        e.replicates, escaped(e.reason));
  }
  return section("next", "The next test", list.empty() ? paragraph(nothing_asked_for(d)) : "<ol>\n" + list + "</ol>\n");
}

/// How well means are known, where the features are in question.
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
        "; of a modulus the simulation's elements leave {} by layout and {} that all layouts share; a "
        "design's mean is known to {} but for what is shared",
        percent(d.discretisation_sd), percent(d.discretisation_shared_sd), percent(error));
  if (const double error = error_of(diagnosis::Feature::log_toughness); error > 0.0)
    words +=
        fmt::format("; a design's toughness, replicates and elements together, to a factor of {:.2f}", std::exp(error));
  return words;
}

/// All that was found, and how.
std::string findings(const Diagnosis& d, tester::Fidelity fidelity) {
  return where_section(d) + curve_part(d) + cause_section(d) + rivals_section(d) + gain_section(d) + next_section(d) +
         paragraph(fmt::format("{}. Fidelity {}; {} fracture simulations. Procedure {}.", noise_in_words(d),
                               tester::to_string(fidelity), d.simulations, escaped(d.procedure)),
                   "quiet");
}

}  // namespace

std::string render_diagnosis_page(const Diagnosis& d, const std::string& set, tester::Fidelity fidelity) {
  const std::string title = fmt::format("Diagnosis of {}", escaped(set));
  std::string page = page_begin(title);
  page += fmt::format("<p class=\"eyebrow\">{}</p>\n<h1>{}</h1>\n", title, headline(d));
  page += paragraph(escaped(d.summary), "standing");
  if (!d.noise_known)
    page +=
        paragraph("A scatter of 2 % is assumed where there are no replicates: what is said of those tests hangs on it.",
                  "warning");
  if (fidelity == tester::Fidelity::tiny)
    page += paragraph("Tiny fidelity: specimens of a single unit. The figures serve tests of the program.", "warning");
  if (!is_undecided(d)) page += findings(d, fidelity);
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace nacre::report
