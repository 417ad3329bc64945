#include "report/report_standing.hpp"

#include <fmt/format.h>

#include "game/model.hpp"
#include "report/exhibit.hpp"
#include "report/report_data.hpp"
#include "report/report_diagnosis.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"
#include "run/misfit.hpp"
#include "run/next_round.hpp"

namespace nacre::report {
namespace {

std::string fidelity_words(tester::Fidelity fidelity) {
  switch (fidelity) {
    case tester::Fidelity::tiny:
      return paragraph(
          "Fidelity <code>tiny</code>: specimens of a single unit, for tests of the program. <strong>The figures on "
          "this page mean nothing.</strong>",
          "warning");
    case tester::Fidelity::preview:
      return paragraph(
          "Fidelity <code>preview</code>: the specimens of the thesis pulled twice as fast. That makes them tougher by "
          "a tenth and hardly changes their order: compare with the thesis' figures in kind, not in number.",
          "quiet");
    case tester::Fidelity::full:
      return paragraph("Fidelity <code>full</code>: the specimens of the thesis.", "quiet");
    case tester::Fidelity::fine:
      return paragraph("Fidelity <code>fine</code>: the specimens of the thesis on elements of half the size.",
                       "quiet");
  }
  return "";
}

/// First sentence: where the fronts stand.
std::string fronts_in_words(int round, const wire::RoundSummary& s) {
  const std::string state = s.last ? "the game is over" : "the game goes on";
  if (s.measured_hypervolume_staircase <= 0.0) {
    return fmt::format(
        "Round {} is closed and {}: no pattern has been measured yet. The model predicts a front with a hypervolume "
        "of {} GPa&nbsp;MPa.",
        round, state, figure(s.gamut_hypervolume_staircase));
  }
  return fmt::format(
      "Round {} is closed and {}: the gap between simulation and laboratory is <strong>{} GPa&nbsp;MPa</strong>. The "
      "measured front has a hypervolume of <strong>{} GPa&nbsp;MPa</strong>, the simulated one {}.",
      round, state, figure(s.gap), with_error(s.measured_hypervolume_staircase, s.hypervolume_error),
      figure(s.gamut_hypervolume_staircase));
}

/// Second: whether that is an equilibrium, or why the game ended.
std::string equilibrium_in_words(const wire::RoundSummary& s) {
  const std::string reached = s.equilibrium ? "Equilibrium is reached" : "Equilibrium is not reached";
  if (s.decided_by.empty()) return reached + ".";
  if (!s.last) return fmt::format("{}: {}.", reached, escaped(s.decided_by));
  return fmt::format("<strong>Why the game ended</strong>: {}. {}.", escaped(s.decided_by), reached);
}

/// Third: what the newest diagnosis says.
std::string diagnosis_in_words(const run::RunRecord& run) {
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (!round->second.diagnosis) continue;
    const std::string against = run::misfit_beside_verdict(round->second);
    return fmt::format("Diagnosis of round {}: {}.{}", round->first,
                       escaped(verdict_in_words(round->second.diagnosis->verdict)),
                       against.empty() ? "" : " " + escaped(against));
  }
  return run.is_diagnosed ? "There is no diagnosis yet." : "The scenario turns the diagnosis off.";
}

/// What rounds have brought, and the next is expected to; empty before a pattern is measured.
std::string growth_in_words(const run::RunRecord& run) {
  const run::NextRound next = run::next_round(run);
  if (next.brought.empty()) return "";
  std::string words = escaped(in_words(next));
  for (auto at = words.find("+-"); at != std::string::npos; at = words.find("+-")) words.replace(at, 2, "±");
  return paragraph(fmt::format("Another round: {}.", words));
}

}  // namespace

std::string standing_sentences(const run::RunRecord& run) {
  const auto closed = newest_closed_round(run);
  if (!closed) return paragraph(awaited("the end of round 0, with the first model, gamut and proposals"));
  const wire::RoundSummary& summary = *run.rounds.at(*closed).summary;
  return paragraph(fronts_in_words(*closed, summary), "standing") + paragraph(equilibrium_in_words(summary)) +
         growth_in_words(run) + paragraph(diagnosis_in_words(run)) + fidelity_words(summary.fidelity);
}

std::string machine_in_words(const run::RunRecord& run) {
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (!round->second.model || !game::has_measurement_side(round->second.model->parameters)) continue;
    return fmt::format(
        "The model of round {} contains effects of the testing machine: there the simulated values are those of the "
        "material alone, the measured ones are as recorded.",
        round->first);
  }
  return "";
}

}  // namespace nacre::report
