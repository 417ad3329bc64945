#include "diagnosis/joint_fits.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/contrasts.hpp"
#include "diagnosis/global_fit.hpp"

namespace nacre::diagnosis {
namespace {

const FitRules& rules_of(const Evidence& evidence) { return evidence.settings.procedure.fit; }

FittedModel base_from(const Evidence& evidence, const std::vector<Start>& starts,
                      std::optional<FittedModel> known = std::nullopt) {
  return global_fit(evidence.model, evidence.observations, rules_of(evidence), {}, starts, std::move(known));
}

/// The base model with signatures and contrasts on top of it.
Anchor anchor_at(const Evidence& evidence, FittedModel base) {
  Anchor anchor{std::move(base), {}, {}, {}};
  anchor.signatures = signatures_on(evidence.model, anchor.fit, evidence.effects, rules_of(evidence).sizes);
  anchor.directions = contrast_directions(evidence.observations, anchor.fit.predicted);
  return anchor;
}

/// Base and one effect; from an earlier fit of some size where there is one.
FittedModel single_of(const Evidence& evidence, std::size_t effect) {
  const FitRules& rules = rules_of(evidence);
  std::vector<Start> starts =
      starts_on(evidence.model, evidence.observations, rules, evidence.base.fit, evidence.base.signatures[effect]);
  if (effect < evidence.singles.size()) {
    const FittedModel& earlier = evidence.singles[effect];
    if (std::abs(earlier.u[earlier.base_count]) > rules.nothing) starts = {at_earlier(earlier), starts.back()};
  }
  return global_fit(evidence.model, evidence.observations, rules, {evidence.effects[effect]}, starts);
}

}  // namespace

Evidence with_fits(Evidence evidence, Stretch stretch) {
  const auto report = [&](double share, std::string_view phase) {
    if (evidence.settings.progress)
      evidence.settings.progress(stretch.begin + share * (stretch.end - stretch.begin), phase);
  };
  report(0.0, "fitting the base model");
  const bool is_first = evidence.base.fit.u.size() == 0;
  FittedModel base =
      base_from(evidence, {is_first ? at_centre(evidence.model, evidence.observations, rules_of(evidence), {})
                                    : at_earlier(evidence.base.fit)});
  report(0.3, "signatures of the effects");
  evidence.base = anchor_at(evidence, std::move(base));
  std::vector<FittedModel> singles;
  for (std::size_t k = 0; k < evidence.effects.size(); ++k) {
    report(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(evidence.effects.size()),
           "fitting base and " + evidence.effects[k]);
    singles.push_back(single_of(evidence, k));
  }
  evidence.singles = std::move(singles);
  if (evidence.singles.empty()) return evidence;
  // A gain must not be better optimisation: the base begins once more where the best effect ended.
  const FittedModel& best = evidence.singles[best_single(evidence)];
  const double before = evidence.base.fit.chi2;
  FittedModel again = base_from(evidence, {at_relative(best, best.base_count)}, evidence.base.fit);
  if (again.chi2 >= before - rules_of(evidence).better) return evidence;
  evidence.base = anchor_at(evidence, std::move(again));
  for (std::size_t k = 0; k < evidence.singles.size(); ++k) {
    const std::vector<Start> starts = starts_on(evidence.model, evidence.observations, rules_of(evidence),
                                                evidence.base.fit, evidence.base.signatures[k]);
    evidence.singles[k] = global_fit(evidence.model, evidence.observations, rules_of(evidence), {evidence.effects[k]},
                                     starts, evidence.singles[k]);
  }
  return evidence;
}

Eigen::VectorXd with_constants_at_centre(const FeatureModel& model, Eigen::VectorXd u) {
  const Eigen::VectorXd constants = model.base_map().coordinates(model.basis().centre);
  u.head(constants.size()) = constants;
  return u;
}

}  // namespace nacre::diagnosis
