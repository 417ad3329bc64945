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

RoundsRow rounds_row(const run::RunRecord& run) {
  RoundsRow row;
  for (const auto& [number, round] : run.rounds)
    row.rounds.push_back(
        {number, &round, points_of(optimize::pareto_front(means(run::measured_patterns(run, number))))});
  for (const auto& pattern : run::measured_patterns(run, run::newest_round(run).value_or(0)))
    row.measured.push_back({pattern});
  return row;
}

}  // namespace nacre::dashboard
