#include "diagnosis/global_fit.hpp"

#include <cmath>
#include <limits>

namespace nacre::diagnosis {
namespace {

/// Whether a descent may still matter.
bool is_worth_it(const Start& start, const FittedModel& best, double last_gain, const FitRules& rules) {
  if (start.promise) return *start.promise < best.chi2 - rules.converged;
  const auto rows = static_cast<double>(best.predicted.size());
  const bool is_noise = best.chi2 <= rows + rules.noise_sd * std::sqrt(2.0 * rows);
  return !is_noise && last_gain >= rules.better;
}

/// Effects whose size can be tried without a simulation: one of the machine, and nothing else.
bool is_of_machine(const std::vector<std::string>& effects) {
  return effects.size() == 1 && material::acts_in_measurement(effects.front());
}

}  // namespace

FittedModel global_fit(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                       const std::vector<std::string>& effects, const std::vector<Start>& starts,
                       std::optional<FittedModel> known) {
  std::optional<FittedModel> best = std::move(known);
  double last_gain = std::numeric_limits<double>::infinity();
  for (const Start& start : starts) {
    if (best && !is_worth_it(start, *best, last_gain, rules)) continue;
    FittedModel fit = fit_model(model, observations, rules, effects, start.u(best ? &*best : nullptr));
    fit.from = start.kind;
    if (best) last_gain = best->chi2 - fit.chi2;
    if (!best || fit.chi2 < best->chi2) best = std::move(fit);
  }
  return *std::move(best);
}

Start at_centre(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                const std::vector<std::string>& effects) {
  const auto u = [&model, &observations, &rules, effects](const FittedModel* best) -> Eigen::VectorXd {
    const Eigen::VectorXd constants = model.base_map().coordinates(model.basis().centre);
    if (best == nullptr) return constants;
    std::vector<Eigen::VectorXd> points = {best->u};
    points.front().head(constants.size()) = constants;
    if (!is_of_machine(effects)) return points.front();
    for (const double size : rules.restart_sizes) {
      points.push_back(points.front());
      points.back()[constants.size()] = size;
    }
    const CoordinateMap map = model.map(effects);
    const Eigen::MatrixXd predicted = model.predict(map, points);
    const Whitener whitener(observations.covariance());
    std::vector<double> chi2;
    for (const auto& column : predicted.colwise()) chi2.push_back(whitener.chi2(observations.values - column));
    return points[std::ranges::min_element(chi2) - chi2.begin()];
  };
  return {StartKind::centre, u};
}

Start at_earlier(const FittedModel& fit) {
  return {StartKind::earlier, [u = fit.u](const FittedModel*) { return u; }};
}

Start at_relative(const FittedModel& richer, Eigen::Index coordinates) {
  return {StartKind::relative, [u = Eigen::VectorXd(richer.u.head(coordinates))](const FittedModel*) { return u; },
          richer.chi2};
}

std::vector<Start> starts_on(const FeatureModel& model, const Observations& observations, const FitRules& rules,
                             const FittedModel& anchor, const Signature& signature) {
  std::vector<std::string> effects = anchor.effects;
  effects.push_back(signature.effect);
  return {{StartKind::signature,
           [&](const FittedModel*) { return best_initial_guess(model, observations, anchor, signature, rules); }},
          at_centre(model, observations, rules, effects),
          {StartKind::anchor,
           [&model, &anchor, effects](const FittedModel*) { return widened_start(anchor, model.map(effects)); },
           anchor.chi2}};
}

}  // namespace nacre::diagnosis
