#include "dashboard/rounds_view.hpp"

#include "optimize/pareto.hpp"

namespace nacre::dashboard {
namespace {

std::vector<optimize::Performance> means(const std::vector<run::MeasuredPattern>& patterns) {
  std::vector<optimize::Performance> points;
  for (const auto& each : patterns) points.push_back(each.mean);
  return points;
}

}  // namespace

RoundsRow rounds_row(const run::RunRecord& run, const std::optional<LiveSearch::Progress>& search) {
  RoundsRow row;
  const auto searched = [&](int number) { return search && search->round == number ? search->patterns : 0; };
  for (const auto& [number, round] : run.rounds)
    row.rounds.push_back(
        {.number = number,
         .round = &round,
         .gamut_count = round.gamut_count > 0 ? round.gamut_count : searched(number),
         .measured_front = points_of(optimize::pareto_front(means(run::measured_patterns(run, number))))});
  if (search && !run.rounds.contains(search->round))
    row.rounds.push_back({.number = search->round, .gamut_count = search->patterns, .measured_front = {}});
  for (const auto& pattern : run::measured_patterns(run, run::newest_round(run).value_or(0)))
    row.measured.push_back({pattern});
  if (run.revealed) row.revealed = RevealedRow{&*run.revealed};
  return row;
}

}  // namespace nacre::dashboard
