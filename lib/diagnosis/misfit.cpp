#include "diagnosis/misfit.hpp"

#include <algorithm>

namespace nacre::diagnosis {
namespace {

double of_both_tests(const std::vector<DrawStatistics>& draws, const DrawStatistics& own) {
  const double contrast = exceedance(over_draws(draws, &DrawStatistics::largest_contrast), own.largest_contrast());
  return std::min(1.0, 2.0 * std::min(omnibus_chance(draws, own), contrast));
}

}  // namespace

std::vector<double> over_draws(const std::vector<DrawStatistics>& draws,
                               const std::function<double(const DrawStatistics&)>& value) {
  std::vector<double> values;
  for (const DrawStatistics& draw : draws) values.push_back(value(draw));
  return values;
}

std::vector<Contrast> judged_contrasts(const Evidence& evidence) {
  const std::vector<double> largest = over_draws(evidence.base_draws, &DrawStatistics::largest_contrast);
  std::vector<Contrast> contrasts;
  for (std::size_t i = 0; i < evidence.base.directions.size(); ++i) {
    const double statistic = evidence.base_statistics.contrasts[i];
    const ContrastDirection& direction = evidence.base.directions[i];
    contrasts.push_back({direction.name, direction.view, statistic, exceedance(largest, statistic)});
  }
  std::stable_sort(contrasts.begin(), contrasts.end(),
                   [](const Contrast& a, const Contrast& b) { return a.statistic > b.statistic; });
  return contrasts;
}

double chance_of_base_misfit(const Evidence& evidence) {
  return of_both_tests(evidence.base_draws, evidence.base_statistics);
}

double chance_of_misfit(const Evidence& evidence, const FittedModel& fit) {
  const Anchor anchor{
      fit, {}, contrast_directions(evidence.observations, fit.predicted), parts_of_rows(evidence.observations)};
  const std::vector<DrawStatistics> draws =
      bootstrap_anchor(anchor, evidence.observations, evidence.settings.procedure.names.imitated,
                       evidence.settings.bootstraps, evidence.settings.seed + 1);
  const DrawStatistics own =
      anchor_statistics(anchor, {evidence.observations.values, Whitener(evidence.observations.covariance())},
                        evidence.settings.procedure.names.imitated);
  return of_both_tests(draws, own);
}

}  // namespace nacre::diagnosis
