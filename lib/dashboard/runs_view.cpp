#include "dashboard/runs_view.hpp"

#include "run/measured_patterns.hpp"

namespace nacre::dashboard {

void enter_standing(ListedRunRow& row, const run::RunRecord& run, bool is_playing) {
  row.state = run::is_over(run) ? "finished" : is_playing ? "playing" : "stopped";
  row.round = run::newest_closed_round(run);
  if (!row.round) return;
  const wire::RoundSummary& last = *run.rounds.at(*row.round).summary;
  if (last.measured_hypervolume_staircase <= 0.0) return;
  row.measured_hypervolume = last.measured_hypervolume_staircase;
  row.hypervolume_error = last.hypervolume_error;
  row.gap = last.gap;
}

}  // namespace nacre::dashboard
