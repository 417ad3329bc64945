#include "diagnosis/name_tests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/discrepancy_model.hpp"
#include "diagnosis/shared_discretisation.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

/// Coordinates of a model without those of one of its effects.
Eigen::VectorXd coordinates_without(const CoordinateMap& map, const FittedModel& model, std::size_t effect) {
  const int first = map.first_coordinate(effect);
  const bool is_last = effect + 1 == model.effects.size();
  const int end = is_last ? map.size() : map.first_coordinate(effect + 1);
  Eigen::VectorXd rest(map.size() - (end - first));
  rest << model.u.head(first), model.u.tail(map.size() - end);
  return rest;
}

/// The base with one effect: the single fit, or, of a law that is none of the single effects, one from where a model
/// with both has it.
FittedModel single_fit(const Evidence& evidence, const std::string& effect, const Eigen::VectorXd& start) {
  const std::vector<std::string> name = {effect};
  const auto known = std::ranges::find(evidence.singles, name, &FittedModel::effects);
  if (known != evidence.singles.end()) return *known;
  return fit_model(evidence.model, evidence.observations, evidence.settings.procedure.fit, name, start);
}

/// The anchor to which one effect of a model is added: the base, or the base with the other effect.
Anchor anchor_without(const Evidence& evidence, const FittedModel& model, std::size_t effect) {
  if (model.effects.size() == 1) return evidence.base;
  Anchor anchor;
  const CoordinateMap map = evidence.model.map(model.effects);
  anchor.fit = single_fit(evidence, model.effects[1 - effect], coordinates_without(map, model, effect));
  std::vector<std::string> others = evidence.effects;
  std::erase(others, anchor.fit.effects.front());
  anchor.signatures = signatures_on(evidence.model, anchor.fit, others, evidence.settings.procedure.fit.sizes);
  anchor.directions = contrast_directions(evidence.observations, anchor.fit.predicted);
  anchor.parts = parts_of_rows(evidence.observations);
  return anchor;
}

/// Signal-to-noise ratio of the weakest effect of a model at its own constants and with its own discretisation error,
/// beyond what moving the constants, and the other effect, imitates, or would were they not bounded: an effect that
/// only makes up for a bound has no signature of its own. Not at the base's constants: they moved as far as they could
/// to imitate the effect, and derivatives and discretisation error there say little of the true ones.
double weakest_signal(const Evidence& evidence, const FittedModel& model) {
  const FittedModel fit = fit_with_own_discretisation(evidence, model.effects, model.u).fit;
  const CoordinateMap map = evidence.model.map(fit.effects);
  const Whitener whitener(with_discretisation_at(evidence, map, fit.u).covariance());
  double weakest = std::numeric_limits<double>::infinity();
  for (std::size_t effect = 0; effect < fit.effects.size(); ++effect) {
    std::vector<std::string> others = fit.effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(effect));
    const FittedModel rest = linearised(evidence.model, others, coordinates_without(map, fit, effect));
    weakest = std::min(weakest, signature_size(rest, fit.predicted - rest.predicted, whitener).projected);
  }
  return weakest;
}

/// The directions along which an unmodelled cause may act beside these effects. What changes with the strain rate is
/// rate dependence, whatever its form: where rate alone differs nothing else can look like it, and where it goes with
/// another condition the direction of that one stays.
Anchor without_own_direction(Anchor anchor, std::span<const std::string> effects) {
  if (have_rate_law(effects))
    std::erase_if(anchor.directions,
                  [](const ContrastDirection& direction) { return direction.view.against == kStrainRate; });
  return anchor;
}

/// The contrast, or smooth law of the stiffness, that explains more when it is added to the anchor in place of the
/// model's effect. Effects that are such a contrast themselves, like a drift from batch to batch, are level with it;
/// others must beat it.
std::string contrast_instead(const Observations& observations, Anchor anchor, const NoisyData& data,
                             const FittedModel& model, const NameRules& rules) {
  for (ContrastDirection& law : smooth_law_directions(observations, anchor.fit.predicted, rules.powers))
    anchor.directions.push_back(std::move(law));
  const std::vector<double> by_contrasts = anchor_statistics(anchor, data, rules.imitated).contrasts;
  if (by_contrasts.empty()) return {};
  const auto most = std::ranges::max_element(by_contrasts);
  const double lead = std::pow(*most, 2) - (anchor.fit.chi2 - model.chi2);
  return lead > rules.contrast_tie ? anchor.directions[most - by_contrasts.begin()].name : std::string();
}

/// A condition of the specimens, one factor on which does as well as the effect; empty when none does.
std::string condition_instead(const Observations& observations, Anchor anchor, const NoisyData& data,
                              const FittedModel& model, const NameRules& rules) {
  anchor.directions = even_directions(observations);
  const std::vector<double> by_factors = anchor_statistics(anchor, data, rules.imitated).contrasts;
  for (std::size_t i = 0; i < by_factors.size(); ++i) {
    const double lead = anchor.fit.chi2 - model.chi2 - std::pow(by_factors[i], 2);
    if (lead < rules.even_lead) return anchor.directions[i].name;
  }
  return {};
}

}  // namespace

NameTests tested_for_a_name(const Evidence& evidence, const FittedModel& model) {
  const Observations& observations = evidence.observations;
  const NameRules& rules = evidence.settings.procedure.names;
  const double discrepancy_level = evidence.settings.procedure.levels.discrepancy;
  const NoisyData data{observations.values, Whitener(observations.covariance())};
  const double signal = weakest_signal(evidence, model);
  const int count = static_cast<int>(model.effects.size());
  NameTests tests{.p_outside = tested_against_discrepancy(evidence, without_own_direction(evidence.base, model.effects),
                                                          model.chi2, count)
                                   .p};
  std::string contrast, condition;
  for (std::size_t effect = 0; effect < model.effects.size(); ++effect) {
    const Anchor anchor = anchor_without(evidence, model, effect);
    if (count > 1)
      tests.p_outside = std::max(
          tests.p_outside, tested_against_discrepancy(
                               evidence, without_own_direction(anchor, {&model.effects[effect], 1}), model.chi2, 1)
                               .p);
    if (contrast.empty()) contrast = contrast_instead(observations, anchor, data, model, rules);
    if (condition.empty()) condition = condition_instead(observations, anchor, data, model, rules);
  }
  const auto nearest = [&](Reason reason) { return Finding{.reason = reason, .nearest = model.effects}; };
  if (signal < rules.nameable_signal()) {
    tests.objection = nearest(Reason::weak_signal);
    tests.objection->value = signal;
    tests.objection->needed = rules.nameable_signal();
  } else if (!contrast.empty()) {
    tests.objection = nearest(Reason::contrast);
    tests.objection->along = contrast;
  } else if (!condition.empty()) {
    tests.objection = nearest(Reason::condition);
    tests.objection->along = condition;
  } else if (tests.p_outside > discrepancy_level) {
    tests.objection = nearest(Reason::discrepancy);
    tests.objection->value = tests.p_outside;
    tests.objection->needed = discrepancy_level;
  }
  return tests;
}

}  // namespace nacre::diagnosis
