#include "diagnosis/misfit.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/contrasts.hpp"

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

std::vector<std::string> conditions_alike(const Evidence& evidence, const Contrast& contrast) {
  constexpr double kSame = 0.98;
  const std::vector<ContrastDirection>& directions = evidence.base.directions;
  const auto own = std::ranges::find(directions, contrast.name, &ContrastDirection::name);
  if (own == directions.end() || !is_condition(contrast.view.against)) return {};
  Eigen::MatrixXd values(evidence.observations.size(), static_cast<Eigen::Index>(directions.size()));
  for (Eigen::Index k = 0; k < values.cols(); ++k) values.col(k) = directions[k].values;
  const Eigen::MatrixXd beyond =
      projected_signatures(evidence.base.fit, values, Whitener(evidence.observations.covariance()));
  const auto along = beyond.col(own - directions.begin());
  std::vector<std::string> alike;
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const ContrastView& view = directions[k].view;
    if (!is_condition(view.against) || view.against == contrast.view.against || view.feature != contrast.view.feature ||
        view.test != contrast.view.test)
      continue;
    if (std::abs(beyond.col(k).dot(along)) >= kSame * beyond.col(k).norm() * along.norm())
      alike.push_back(view.against);
  }
  return alike;
}

double chance_of_base_misfit(const Evidence& evidence) {
  return of_both_tests(evidence.base_draws, evidence.base_statistics);
}

double chance_of_misfit(const Evidence& evidence, const FittedModel& fit) {
  return chance_of_misfit(evidence.observations, fit, evidence.settings);
}

double chance_of_misfit(const Observations& observations, const FittedModel& fit, const DiagnosisSettings& settings) {
  const Anchor anchor{fit, {}, contrast_directions(observations, fit.predicted), parts_of_rows(observations)};
  const double imitated = settings.procedure.names.imitated;
  const std::vector<DrawStatistics> draws =
      bootstrap_anchor(anchor, observations, imitated, settings.bootstraps, settings.seed + 1);
  const DrawStatistics own =
      anchor_statistics(anchor, {observations.values, Whitener(observations.covariance())}, imitated);
  return of_both_tests(draws, own);
}

}  // namespace nacre::diagnosis
