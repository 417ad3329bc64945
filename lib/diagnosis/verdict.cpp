#include "diagnosis/verdict.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "diagnosis/candidates.hpp"
#include "diagnosis/name_tests.hpp"
#include "diagnosis/other_materials.hpp"

namespace nacre::diagnosis {
namespace {

template <class Value>
std::vector<double> over_draws(const std::vector<DrawStatistics>& draws, Value value) {
  std::vector<double> values;
  for (const DrawStatistics& draw : draws) values.push_back(value(draw));
  return values;
}

/// Contrasts of the base model's residuals with family-wise chances, strongest first.
std::vector<Contrast> judged_contrasts(const Evidence& evidence) {
  const std::vector<double> largest =
      over_draws(evidence.base_draws, [](const DrawStatistics& d) { return d.largest_contrast(); });
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

/// Chance of a misfit as large as that of this model when it is true: the smaller of the omnibus and the contrast test,
/// doubled because there are two of them.
double chance_of_misfit(const Evidence& evidence, const FittedModel& fit) {
  const Anchor anchor{
      fit, {}, contrast_directions(evidence.observations, fit.predicted), parts_of_rows(evidence.observations)};
  const std::vector<DrawStatistics> draws =
      bootstrap_anchor(anchor, evidence.observations, evidence.settings.procedure.names.imitated,
                       evidence.settings.bootstraps, evidence.settings.seed + 1);
  const DrawStatistics own =
      anchor_statistics(anchor, {evidence.observations.values, Whitener(evidence.observations.covariance())},
                        evidence.settings.procedure.names.imitated);
  const double contrast = exceedance(over_draws(draws, [](const DrawStatistics& d) { return d.largest_contrast(); }),
                                     own.largest_contrast());
  return std::min(1.0, 2.0 * std::min(omnibus_chance(draws, own), contrast));
}

bool usable(const FittedModel& fit, double p_fit, double level) { return p_fit >= level && !fit.extension_on_bound; }

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
  return std::min(from(model.u), from(at_first_constants(evidence, model.u)));
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
    if (!usable(rivals[k], p_fit[k], evidence.settings.procedure.levels.exclusion)) continue;
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

/// Models that the data cannot distinguish from the best one, the best first: each fits by itself and is not excluded
/// by draws under the discretisation error of all models; where elements matter, the profile deviance decides with
/// them.
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

/// Effects that pairs are built on, the best first: alone, a collinear effect may explain more than the cause, which
/// needs a second effect.
std::vector<std::size_t> pair_anchors(const Evidence& evidence) {
  const NameRules& rules = evidence.settings.procedure.names;
  std::vector<std::size_t> anchors(evidence.singles.size());
  std::iota(anchors.begin(), anchors.end(), std::size_t{0});
  std::ranges::stable_sort(anchors, {}, [&](std::size_t k) { return evidence.singles[k].chi2; });
  const auto drop = [&](std::size_t k) { return evidence.base.fit.chi2 - evidence.singles[k].chi2; };
  std::erase_if(anchors,
                [&, best = drop(anchors.front())](std::size_t k) { return drop(k) < rules.pair_share * best; });
  anchors.resize(std::min(anchors.size(), static_cast<std::size_t>(rules.pair_anchors)));
  return anchors;
}

/// Pairs that contain a single effect, where the second effect earns its place on top of the first.
std::vector<FittedModel> significant_pairs(const Evidence& evidence, const FittedModel& single) {
  std::vector<std::string> others;
  for (const std::string& effect : evidence.effects) {
    if (effect != single.effects.front()) others.push_back(effect);
  }
  const Anchor anchor{
      single, signatures_on(evidence.model, single, others, evidence.settings.procedure.fit.sizes), {}, {}};
  const std::vector<double> largest =
      over_draws(bootstrap_anchor(anchor, evidence.observations, evidence.settings.procedure.names.imitated,
                                  evidence.settings.bootstraps, evidence.settings.seed + 3),
                 [](const DrawStatistics& d) { return d.largest_drop(); });
  std::vector<FittedModel> pairs;
  for (std::size_t k = 0; k < others.size(); ++k) {
    FittedModel pair =
        restarted(evidence, fit_model(evidence.model, evidence.observations, evidence.settings.procedure.fit,
                                      {single.effects.front(), others[k]},
                                      best_initial_guess(evidence.model, evidence.observations, single,
                                                         anchor.signatures[k], evidence.settings.procedure.fit)));
    if (exceedance(largest, single.chi2 - pair.chi2) <= evidence.settings.procedure.levels.name)
      pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// Refits the effect that these pairs share by itself, restarted from where each pair ended: a pair may have found an
/// optimum that its first effect missed alone, and its gain must not be better optimisation. True when the effect fits
/// better now.
bool fitted_better_alone(Evidence& evidence, std::size_t effect, const std::vector<FittedModel>& pairs) {
  const FitRules& rules = evidence.settings.procedure.fit;
  FittedModel& single = evidence.singles[effect];
  const double before = single.chi2;
  for (const FittedModel& pair : pairs) {
    FittedModel alone =
        fit_model(evidence.model, evidence.observations, rules, single.effects, pair.u.head(single.u.size()));
    if (alone.chi2 < single.chi2) single = std::move(alone);
  }
  return single.chi2 < before - rules.better_alone;
}

/// Pairs on all anchors, each once; nothing when an anchor was fitted better on the way.
std::optional<std::vector<FittedModel>> pairs_of_best(Evidence& evidence) {
  std::vector<FittedModel> pairs;
  std::set<std::set<std::string>> known;
  for (const std::size_t anchor : pair_anchors(evidence)) {
    std::vector<FittedModel> built = significant_pairs(evidence, evidence.singles[anchor]);
    if (fitted_better_alone(evidence, anchor, built)) return std::nullopt;
    for (FittedModel& pair : built)
      if (known.insert({pair.effects.begin(), pair.effects.end()}).second) pairs.push_back(std::move(pair));
  }
  return pairs;
}

Decision unexplained(Decision decision, const std::vector<FittedModel>& tried, Finding finding) {
  decision.verdict = Verdict::unexplained;
  decision.finding = std::move(finding);
  if (!tried.empty()) {
    decision.partial = *std::min_element(tried.begin(), tried.end(),
                                         [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  }
  return decision;
}

/// Names one, or keeps several (`possible` is not empty); none where an unmodelled cause could look the same.
Decision settled(const Evidence& evidence, Decision decision, std::vector<FittedModel> possible, Reason reason) {
  const FittedModel& best = possible.front();
  const NameTests tests = tested_for_a_name(evidence, best);
  decision.p_outside = tests.p_outside;
  if (tests.objection) return unexplained(std::move(decision), possible, *tests.objection);
  decision.verdict = possible.size() == 1 ? Verdict::named : Verdict::ambiguous;
  decision.possible = std::move(possible);
  decision.finding.reason = reason;
  return decision;
}

/// Why an effect whose residuals are noise is not named: it is at its bound.
Finding at_its_bound(const FittedModel& single) {
  return {.reason = Reason::at_bound,
          .nearest = single.effects,
          .value = single.parameters.extensions.at(single.effects.front()).front()};
}

std::size_t best_single(const Evidence& evidence) {
  const auto best = std::min_element(evidence.singles.begin(), evidence.singles.end(),
                                     [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  return static_cast<std::size_t>(best - evidence.singles.begin());
}

/// Of every single effect. One far behind the best cannot be in the set: its misfit is not bootstrapped.
std::vector<double> chances_of_misfit(const Evidence& evidence, std::size_t best) {
  std::vector<double> chances;
  for (const FittedModel& single : evidence.singles) {
    const bool in_reach = single.chi2 <= evidence.singles[best].chi2 + evidence.settings.procedure.fit.far_behind;
    chances.push_back(in_reach ? chance_of_misfit(evidence, single) : 0.0);
  }
  return chances;
}

/// Base materials whose E only layouts tell, and which those want beyond the bounds of the search.
std::vector<ModulusAtBound> untold_moduli_at_bounds(const Evidence& evidence) {
  std::vector<ModulusAtBound> moduli = evidence.model.base_map().moduli_at_bounds(evidence.base.fit.u);
  std::erase_if(moduli, [&](const ModulusAtBound& each) {
    return each.of_coupons || is_told_by_own_specimens(evidence.observations, each.material);
  });
  return moduli;
}

/// The base where these moduli are searched three times as far; nothing where it misfits there too.
std::optional<FittedModel> base_of_other_materials(const Evidence& evidence,
                                                   const std::vector<ModulusAtBound>& moduli) {
  Basis basis = evidence.model.basis();
  for (const ModulusAtBound& each : moduli) {
    material::ParameterRange& range = basis.ranges.microstructure_modulus[each.material];
    const double ratio = range.maximum / range.minimum;
    range.minimum /= ratio;
    range.maximum *= ratio;
  }
  const FeatureModel wider(evidence.observations, basis, evidence.settings.fidelity, evidence.model.surface());
  FittedModel fit = fit_model(wider, evidence.observations, evidence.settings.procedure.fit, {},
                              wider.base_map().coordinates(evidence.base.fit.parameters));
  if (chance_of_misfit(evidence, fit) < evidence.settings.procedure.levels.unexplained) return std::nullopt;
  return fit;
}

/// Another material or a missing effect: layouts alone cannot tell. Empty where no constant of another material makes
/// the base fit.
std::optional<Decision> decided_for_its_own_specimens(const Evidence& evidence, Decision decision) {
  std::vector<ModulusAtBound> moduli = untold_moduli_at_bounds(evidence);
  if (moduli.empty()) return std::nullopt;
  const std::optional<FittedModel> fit = base_of_other_materials(evidence, moduli);
  if (!fit) return std::nullopt;
  const material::ModulusVector found = to_vector(fit->parameters.modulus);
  for (ModulusAtBound& each : moduli) each.modulus_pa = found[each.material];
  decision.verdict = Verdict::ambiguous;
  decision.partial.reset();
  decision.finding = {.reason = Reason::other_material};
  decision.untold = std::move(moduli);
  return decision;
}

Decision decide_among_effects(Evidence& evidence) {
  const auto report = [&](double share, std::string_view phase) {
    if (evidence.settings.progress) evidence.settings.progress(share, phase);
  };
  Decision decision;
  decision.contrasts = judged_contrasts(evidence);
  const std::vector<double> largest_drops =
      over_draws(evidence.base_draws, [](const DrawStatistics& d) { return d.largest_drop(); });
  const double omnibus = omnibus_chance(evidence.base_draws, evidence.base_statistics);
  const double contrast = decision.contrasts.empty() ? 1.0 : decision.contrasts.front().p_family_wise;
  decision.p_misfit = std::min(1.0, 2.0 * std::min(omnibus, contrast));
  decision.loudest_part = loudest_part(evidence.base_draws, evidence.base_statistics);
  for (const FittedModel& single : evidence.singles) {
    decision.p_family_wise.push_back(exceedance(largest_drops, evidence.base.fit.chi2 - single.chi2));
    decision.p_fit.push_back(1.0);
  }
  const double best_p = decision.p_family_wise.empty()
                            ? 1.0
                            : *std::min_element(decision.p_family_wise.begin(), decision.p_family_wise.end());
  if (best_p > evidence.settings.procedure.levels.name) {
    if (decision.p_misfit >= evidence.settings.procedure.levels.unexplained) {
      decision.finding.reason = Reason::residuals_are_noise;
      return decision;
    }
    return unexplained(std::move(decision), evidence.singles, {.reason = Reason::no_effect_helps});
  }
  report(0.8, "testing the residuals of each effect");
  const std::size_t best = best_single(evidence);
  decision.p_fit = chances_of_misfit(evidence, best);
  // A second effect would only make up for the bound of the first one.
  if (decision.p_fit[best] >= evidence.settings.procedure.levels.unexplained &&
      evidence.singles[best].extension_on_bound)
    return unexplained(std::move(decision), {evidence.singles[best]}, at_its_bound(evidence.singles[best]));
  if (usable(evidence.singles[best], decision.p_fit[best], evidence.settings.procedure.levels.unexplained)) {
    report(0.85, "comparing rival effects");
    std::vector<FittedModel> possible = confidence_set(evidence, evidence.singles, decision.p_fit);
    return settled(evidence, std::move(decision), std::move(possible), Reason::one_effect);
  }
  report(0.9, "fitting pairs of effects");
  const std::optional<std::vector<FittedModel>> pairs = pairs_of_best(evidence);
  if (!pairs) return decide_among_effects(evidence);
  std::vector<double> pair_p;
  for (const FittedModel& pair : *pairs) pair_p.push_back(chance_of_misfit(evidence, pair));
  const bool some_pair_fits = std::any_of(
      pair_p.begin(), pair_p.end(), [&](double p) { return p >= evidence.settings.procedure.levels.unexplained; });
  std::vector<FittedModel> possible =
      some_pair_fits ? confidence_set(evidence, *pairs, pair_p) : std::vector<FittedModel>{};
  if (possible.empty()) {
    std::vector<FittedModel> tried = evidence.singles;
    tried.insert(tried.end(), pairs->begin(), pairs->end());
    return unexplained(std::move(decision), tried, {.reason = Reason::residuals_stay});
  }
  return settled(evidence, std::move(decision), std::move(possible), Reason::two_effects);
}

}  // namespace

Decision decide(Evidence& evidence) {
  Decision decision = decide_among_effects(evidence);
  if (decision.verdict != Verdict::unexplained && decision.verdict != Verdict::base_sufficient) return decision;
  if (auto other = decided_for_its_own_specimens(evidence, decision)) return *std::move(other);
  return decision;
}

}  // namespace nacre::diagnosis
