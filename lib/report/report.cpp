#include "report/report.hpp"

#include <fmt/format.h>

#include "game/model.hpp"
#include "report/report_data.hpp"
#include "report/report_figures.hpp"
#include "report/report_sections.hpp"
#include "report/report_style.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"
#include "store/misfit.hpp"

namespace nacre::report {
namespace {

std::string fidelity_words(tester::Fidelity fidelity) {
  switch (fidelity) {
    case tester::Fidelity::tiny:
      return paragraph(
          "Tiny fidelity: specimens of a single unit, for tests of processes and faults. <strong>The figures on this "
          "page mean "
          "nothing.</strong>",
          "warning");
    case tester::Fidelity::preview:
      return paragraph(
          "Preview fidelity: the specimens of the thesis pulled twice as fast, which makes them tougher by a tenth "
          "and ranks them nearly alike. Compare with the thesis' figures in kind, not in number.",
          "quiet");
    case tester::Fidelity::full:
      return paragraph("Full fidelity: the specimens of the thesis.", "quiet");
  }
  return "";
}

/// First sentence: where the fronts stand.
std::string figures_in_words(int round, const wire::RoundSummary& s) {
  const std::string state = s.last ? "the game is over" : "the game goes on";
  if (s.measured_hypervolume_staircase <= 0.0) {
    return fmt::format(
        "Round {} is closed and {}: no pattern has been measured yet; the simulator believes in a hypervolume of {} "
        "GPa&nbsp;MPa.",
        round, state, figure(s.gamut_hypervolume_staircase));
  }
  return fmt::format(
      "Round {} is closed and {}: the gap between simulated and measured front is <strong>{} GPa&nbsp;MPa</strong>, "
      "with a measured hypervolume of "
      "<strong>{} GPa&nbsp;MPa</strong> where the simulator believes in {}.",
      round, state, figure(s.gap), with_error(s.measured_hypervolume_staircase, s.hypervolume_error),
      figure(s.gamut_hypervolume_staircase));
}

/// Second sentence: whether that is an equilibrium, and what the last diagnosis says.
std::string judgement_in_words(const store::RunRecord& run, const wire::RoundSummary& s) {
  std::string words = s.equilibrium ? "Equilibrium is reached" : "Equilibrium is not reached";
  if (!s.decided_by.empty()) words += fmt::format(" ({})", escaped(s.decided_by));
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (!round->second.diagnosis) continue;
    const std::string against = store::misfit_beside_verdict(round->second);
    return words + fmt::format("; the diagnosis of round {}: {}.{}", round->first,
                               verdict_in_words(round->second.diagnosis->verdict),
                               against.empty() ? "" : " " + escaped(against));
  }
  return words + "; there is no diagnosis yet.";
}

/// Where the model holds faults of the testing machine, simulated and measured values mean different things.
std::string machine_in_words(const store::RunRecord& run) {
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    material::ParameterSet model;
    model.extensions = extensions_of(round->second);
    if (!game::has_measurement_side(model)) continue;
    return paragraph(
        fmt::format("The model of round {} holds effects of the testing machine: there the simulated values are the "
                    "material's own, the measured "
                    "ones as the machine shows them.",
                    round->first));
  }
  return "";
}

std::string contents() {
  return "<nav><a href=\"#gamuts\">Gamuts</a><a href=\"#rounds\">Rounds</a><a href=\"#errors\">Errors</a><a "
         "href=\"#best\">Best designs</a>"
         "<a href=\"#proposals\">Proposals</a><a href=\"#curves\">Curves</a><a href=\"#diagnosis\">Diagnosis</a>"
         "<a href=\"#specimens\">Specimens</a></nav>\n";
}

}  // namespace

std::string section(std::string_view anchor, std::string_view heading, const std::string& content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", anchor, heading, content);
}

std::string paragraph(std::string_view words, std::string_view classes) {
  return classes.empty() ? fmt::format("<p>{}</p>\n", words) : fmt::format("<p class=\"{}\">{}</p>\n", classes, words);
}

std::string awaited(std::string_view what) { return paragraph(fmt::format("Still awaited: {}.", what), "awaited"); }

std::string table_row(const std::vector<std::string>& cells, std::string_view classes) {
  std::string row = classes.empty() ? "<tr>" : fmt::format("<tr class=\"{}\">", classes);
  for (const std::string& cell : cells) row += fmt::format("<td>{}</td>", cell);
  return row + "</tr>\n";
}

std::string header_row(std::initializer_list<std::string_view> cells) {
  std::string row = "<tr>";
  for (const std::string_view cell : cells) row += fmt::format("<th scope=\"col\">{}</th>", cell);
  return row + "</tr>\n";
}

std::string table(const std::string& header, const std::string& rows, std::string_view classes) {
  return fmt::format("<div class=\"wide\"><table class=\"{}\">\n<thead>{}</thead>\n<tbody>{}</tbody>\n</table></div>\n",
                     classes, header, rows);
}

std::string standing_sentences(const store::RunRecord& run) {
  const auto closed = newest_closed_round(run);
  if (!closed) return awaited("the end of round 0, with the first model, gamut and proposals");
  const wire::RoundSummary& summary = *run.rounds.at(*closed).summary;
  return paragraph(figures_in_words(*closed, summary) + " " + judgement_in_words(run, summary), "standing") +
         fidelity_words(summary.fidelity);
}

std::string standing_section(const store::RunRecord& run, const std::string& run_id) {
  std::string content =
      fmt::format("<header>\n<p class=\"eyebrow\">nacre, report of a run</p>\n<h1>{}</h1>\n", escaped(run_id));
  content += standing_sentences(run);
  return content + contents() + "</header>\n";
}

std::string gamut_section(const store::RunRecord& run) {
  std::string content = paragraph(
      "What the model of each round believes in (blue) and what was measured until then (orange), on the same axes. A "
      "front's staircase "
      "bounds what is dominated; the area between the two is the gap. Bars: ± 1 standard deviation of the replicates.");
  const std::vector<std::string> figures = gamut_figures(run);
  if (figures.empty()) return section("gamuts", "Gamut and measurements, round by round", awaited("the first gamut"));
  content += machine_in_words(run);
  content += "<div class=\"figures\">\n";
  for (const std::string& each : figures) content += each;
  return section("gamuts", "Gamut and measurements, round by round", content + "</div>\n");
}

std::string round_section(const store::RunRecord& run) {
  const std::vector<std::string> figures = round_figures(run);
  if (figures.empty()) return section("rounds", "Hypervolume and gap", awaited("the end of round 0"));
  std::string content = "<div class=\"figures\">\n";
  for (const std::string& each : figures) content += each;
  content += "</div>\n";
  content += paragraph(
      "Hypervolumes are exact (staircase), with respect to E = 0, T = 0. The error is the bootstrap standard error "
      "over replicates; the game "
      "is in equilibrium when, two rounds running, the measured hypervolume grows by less than it and the signed gap "
      "lies within twice it or "
      "changes by less than 10 %.",
      "quiet");
  return section("rounds", "Hypervolume and gap", content);
}

std::string curve_section(const store::RunRecord& run) {
  const std::vector<std::string> figures = curve_figures(run);
  if (figures.empty())
    return section("curves", "Stress-strain curves", awaited("the first measured curve of a pattern"));
  std::string content = paragraph(
      "Notched specimens printed upright: every measured replicate (orange) and the newest model's curve (blue), as "
      "the testing machine would "
      "show it. Designs measured last come first; all plots share their axes.");
  content += "<div class=\"figures\">\n";
  for (const std::string& each : figures) content += each;
  return section("curves", "Stress-strain curves", content + "</div>\n");
}

std::string render_report(const store::RunRecord& run, const std::string& run_id) {
  return page_begin(escaped(run_id) + " – nacre") + standing_section(run, run_id) + gamut_section(run) +
         round_section(run) + error_section(run) + best_designs_section(run) + proposal_section(run) +
         curve_section(run) + diagnosis_section(run) + specimen_section(run) + "</main>\n</body>\n</html>\n";
}

}  // namespace nacre::report
