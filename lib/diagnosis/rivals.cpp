#include "diagnosis/rivals.hpp"

#include <algorithm>
#include <limits>

#include "diagnosis/joint_fits.hpp"
#include "diagnosis/shared_discretisation.hpp"

namespace nacre::diagnosis {
namespace {

/// Whether data drawn from this rival would let another model win by as much as was observed so seldom that it is
/// excluded.
bool excluded_by_draws(const Evidence& evidence, const std::vector<FittedModel>& rivals, std::size_t rival,
                       double lead) {
  if (lead <= 0.0) return false;
  const RivalStatistics draws =
      bootstrap_rival(rivals, rival, evidence.observations, evidence.settings.bootstraps, evidence.settings.seed + 2);
  return exceedance(draws.lead_of_best_other, lead) < evidence.settings.procedure.levels.exclusion;
}

/// Profile deviance of a model: -2 log likelihood with its own discretisation error (directions that all models share
/// let one of them explain its misfit by the discretisation error of another), the smaller of a fit from its optimum
/// and one restarted from the initial guess of the base.
double profile_deviance(const Evidence& evidence, const FittedModel& model) {
  const auto from = [&](const Eigen::VectorXd& u) {
    return fit_with_own_discretisation(evidence, model.effects, u).deviance;
  };
  return std::min(from(model.u), from(with_constants_at_centre(evidence.model, model.u)));
}

/// Models that fit by themselves, with how far each lies behind the best.
struct Fitting {
  std::vector<FittedModel> models;
  std::vector<bool> excluded_by_draws;
  std::vector<double> behind;  ///< -2 log likelihood; where elements matter with each model's own discretisation error
};

Fitting fitting_among(const Evidence& evidence, const std::vector<FittedModel>& rivals,
                      const std::vector<double>& p_fit) {
  double least = std::numeric_limits<double>::infinity();
  for (const FittedModel& rival : rivals) least = std::min(least, rival.chi2);
  Fitting fitting;
  for (std::size_t k = 0; k < rivals.size(); ++k) {
    if (!is_usable(rivals[k], p_fit[k], evidence.settings.procedure.levels.exclusion)) continue;
    fitting.models.push_back(rivals[k]);
    fitting.excluded_by_draws.push_back(excluded_by_draws(evidence, rivals, k, rivals[k].chi2 - least));
    const bool elements_matter = evidence.observations.has_shared_discretisation();
    fitting.behind.push_back(elements_matter ? profile_deviance(evidence, rivals[k]) : rivals[k].chi2);
  }
  if (fitting.behind.empty()) return fitting;
  const double best = *std::ranges::min_element(fitting.behind);
  for (double& behind : fitting.behind) behind -= best;
  return fitting;
}

}  // namespace

std::vector<FittedModel> confidence_set(const Evidence& evidence, const std::vector<FittedModel>& rivals,
                                        const std::vector<double>& p_fit) {
  const Fitting fitting = fitting_among(evidence, rivals, p_fit);
  const NameRules& rules = evidence.settings.procedure.names;
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < fitting.models.size(); ++k) {
    const bool drawn_out = fitting.excluded_by_draws[k];
    const bool out = evidence.observations.has_shared_discretisation()
                         ? fitting.behind[k] > rules.lead * (drawn_out ? 1.0 : rules.certain_lead)
                         : drawn_out;
    if (!out) order.push_back(k);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return fitting.behind[k]; });
  std::vector<FittedModel> kept;
  for (const std::size_t k : order) kept.push_back(fitting.models[k]);
  return kept;
}

}  // namespace nacre::diagnosis
