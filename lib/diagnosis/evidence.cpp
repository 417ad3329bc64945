#include "diagnosis/evidence.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/contrasts.hpp"

namespace nacre::diagnosis {
namespace {

/// These sizes of an effect, and of a two-sided one their negatives, in the order of a signature's changes.
std::vector<double> signed_sizes(std::span<const double> sizes, bool one_sided) {
  std::vector<double> all(sizes.begin(), sizes.end());
  if (!one_sided)
    for (const double size : sizes) all.push_back(-size);
  return all;
}

/// Shares of the whole work between which a step lies.
struct Stretch {
  double begin = 0.0, end = 1.0;
};

const FitRules& rules_of(const Evidence& evidence) { return evidence.settings.procedure.fit; }

/// The base model with signatures and contrasts on top of it.
void put_base(Evidence& evidence, FittedModel base) {
  evidence.base.fit = std::move(base);
  evidence.base.signatures =
      signatures_on(evidence.model, evidence.base.fit, evidence.effects, rules_of(evidence).sizes);
  evidence.base.directions = contrast_directions(evidence.observations, evidence.base.fit.predicted);
}

/// Base and one effect, from the best initial guess.
FittedModel fit_single(const Evidence& evidence, std::size_t effect) {
  return fit_model(evidence.model, evidence.observations, rules_of(evidence), {evidence.effects[effect]},
                   best_initial_guess(evidence.model, evidence.observations, evidence.base.fit,
                                      evidence.base.signatures[effect], rules_of(evidence)));
}

/// First constants, with the effect size of the smallest chi squared there.
Eigen::VectorXd promising_initial_guess(const Evidence& evidence, const FittedModel& fit) {
  const Eigen::VectorXd first = at_first_constants(evidence, fit.u);
  const Eigen::Index own = evidence.base.fit.u.size();
  const CoordinateMap map = evidence.model.map(fit.effects);
  const Whitener whitener(evidence.observations.covariance());
  std::vector<Eigen::VectorXd> starts;
  for (const double size : rules_of(evidence).restart_sizes) {
    starts.push_back(first);
    starts.back()[own] = size;
  }
  const Eigen::MatrixXd predicted = evidence.model.predict(map, starts);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double chi2 = whitener.chi2(evidence.observations.values - predicted.col(static_cast<Eigen::Index>(i)));
    if (chi2 < least) least = chi2, best = i;
  }
  return starts[best];
}

/// The base is restarted from where the best extended fit ended: a gain must not be better optimisation. Where that
/// helps it, every effect is restarted from there.
void restart_base(Evidence& evidence) {
  const auto best = std::min_element(evidence.singles.begin(), evidence.singles.end(),
                                     [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  if (best == evidence.singles.end() || best->chi2 > evidence.base.fit.chi2 - rules_of(evidence).base_behind) return;
  FittedModel again =
      fit_model(evidence.model, evidence.observations, rules_of(evidence), {}, best->u.head(best->base_count));
  if (again.chi2 >= evidence.base.fit.chi2 - rules_of(evidence).better) return;
  put_base(evidence, std::move(again));
  for (std::size_t k = 0; k < evidence.singles.size(); ++k)
    evidence.singles[k] = better_of(std::move(evidence.singles[k]), fit_single(evidence, k));
}

/// An effect of larger chi squared than the base is caught in a local minimum, since at size 0 it is the base:
/// restarted there.
void restart_at_the_base(Evidence& evidence) {
  for (FittedModel& single : evidence.singles) {
    if (single.chi2 <= evidence.base.fit.chi2 + rules_of(evidence).converged) continue;
    const CoordinateMap map = evidence.model.map(single.effects);
    single = better_of(std::move(single), fit_model(evidence.model, evidence.observations, rules_of(evidence),
                                                    single.effects, widened_start(evidence.base.fit, map)));
  }
}

/// Base and every single effect, fitted to the observations of the evidence.
void fit_models(Evidence& evidence, const Eigen::VectorXd& start, Stretch stretch) {
  const auto report = [&](double share, std::string_view phase) {
    if (evidence.settings.progress)
      evidence.settings.progress(stretch.begin + share * (stretch.end - stretch.begin), phase);
  };
  report(0.0, "fitting the base model");
  FittedModel base = fit_model(evidence.model, evidence.observations, rules_of(evidence), {}, start);
  report(0.3, "signatures of the effects");
  put_base(evidence, std::move(base));
  std::vector<FittedModel> singles;
  for (std::size_t k = 0; k < evidence.effects.size(); ++k) {
    report(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(evidence.effects.size()),
           "fitting base and " + evidence.effects[k]);
    // An earlier fit of some size is the initial guess under another covariance or emulator.
    const bool found = k < evidence.singles.size() &&
                       std::abs(evidence.singles[k].u[evidence.singles[k].base_count]) > rules_of(evidence).nothing;
    singles.push_back(found ? fit_model(evidence.model, evidence.observations, rules_of(evidence),
                                        {evidence.effects[k]}, evidence.singles[k].u)
                            : fit_single(evidence, k));
  }
  evidence.singles = std::move(singles);
  for (FittedModel& single : evidence.singles) single = restarted(evidence, std::move(single));
  restart_base(evidence);
  restart_at_the_base(evidence);
}

/// Models whose change with finer elements is shared among moduli: the base, and every effect of the material that acts
/// on them.
void share_discretisation(Evidence& evidence) {
  evidence.discretisation = {{{}, evidence.base.fit.u}};
  for (const FittedModel& single : evidence.singles)
    if (material::find_effect(single.effects.front())->side == material::EffectSide::material)
      evidence.discretisation.push_back({single.effects, single.u});
  const Eigen::MatrixXd all = shared_directions(evidence, evidence.model);
  std::vector<Eigen::Index> kept;
  std::vector<ModelPoint> acting;
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    if (k > 0 && all.col(k).norm() < 1e-9) continue;
    kept.push_back(k);
    acting.push_back(std::move(evidence.discretisation[k]));
  }
  evidence.discretisation = std::move(acting);
  evidence.observations.discretisation_shared = all(Eigen::all, kept);
  evidence.observations.discretisation_sd = evidence.settings.floor.mesh_remainder_sd;
}

/// Simulates the fracture tests at the base fit and at those of the effects that come nearest, until the emulator
/// predicts them.
void refine_fractures(Evidence& evidence, Workbench& workbench) {
  if (!workbench.has_fractures()) return;
  const EmulatorRules& rules = evidence.settings.procedure.emulator;
  for (int pass = 0; pass < rules.refinements; ++pass) {
    std::vector<const FittedModel*> order;
    for (const FittedModel& single : evidence.singles) order.push_back(&single);
    std::stable_sort(order.begin(), order.end(),
                     [](const FittedModel* a, const FittedModel* b) { return a->chi2 < b->chi2; });
    std::vector<material::ParameterSet> sets = {evidence.base.fit.parameters};
    for (std::size_t k = 0; k < std::min(order.size(), static_cast<std::size_t>(rules.refined_effects)); ++k)
      sets.push_back(order[k]->parameters);
    const double error = workbench.refine(sets);
    const double begin = 0.6 + 0.03 * pass;
    fit_models(evidence, evidence.base.fit.u, {begin, begin + 0.03});
    if (error < rules.well_known) return;
  }
}

}  // namespace

std::vector<Signature> signatures_on(const FeatureModel& model, const FittedModel& anchor,
                                     const std::vector<std::string>& effects, std::span<const double> sizes) {
  std::vector<Signature> signatures;
  for (const std::string& effect : effects) {
    std::vector<std::string> names = anchor.effects;
    names.push_back(effect);
    const CoordinateMap map = model.map(names);
    const int own = anchor.u.size();
    Signature signature{effect, {}, map.lower(own) >= 0.0};
    std::vector<Eigen::VectorXd> points;
    for (const double size : signed_sizes(sizes, signature.one_sided)) {
      points.push_back(widened_start(anchor, map));
      points.back()[own] = std::clamp(size, map.lower(own), map.upper(own));
    }
    signature.changes = model.predict(map, points).colwise() - anchor.predicted;
    signatures.push_back(std::move(signature));
  }
  return signatures;
}

Eigen::MatrixXd shared_directions(const Evidence& evidence, const FeatureModel& model) {
  Eigen::MatrixXd directions(model.size(), static_cast<Eigen::Index>(evidence.discretisation.size()));
  for (std::size_t k = 0; k < evidence.discretisation.size(); ++k) {
    const ModelPoint& point = evidence.discretisation[k];
    directions.col(static_cast<Eigen::Index>(k)) =
        evidence.settings.floor.mesh_amplitude * model.mesh_change(model.map(point.effects), point.u);
    if (k > 0) directions.col(static_cast<Eigen::Index>(k)) -= directions.col(0);
  }
  return directions;
}

FittedModel better_of(FittedModel a, FittedModel b) { return a.chi2 <= b.chi2 ? std::move(a) : std::move(b); }

Eigen::VectorXd at_first_constants(const Evidence& evidence, Eigen::VectorXd u) {
  const Eigen::VectorXd first = evidence.model.base_map().coordinates(evidence.model.basis().centre);
  u.head(first.size()) = first;
  return u;
}

FittedModel restarted(const Evidence& evidence, FittedModel fit) {
  const FitRules& rules = rules_of(evidence);
  const double found = evidence.base.fit.chi2 - fit.chi2;
  const auto again_from = [&](const Eigen::VectorXd& u) {
    FittedModel again = fit_model(evidence.model, evidence.observations, rules_of(evidence), fit.effects, u);
    return better_of(std::move(fit), std::move(again));
  };
  if (found >= rules.far_behind) fit = again_from(at_first_constants(evidence, fit.u));
  // A further fit of every effect to moduli of layouts would double the work; effects of a machine on curves need it.
  const bool is_far_off = fit.chi2 > evidence.observations.size() + rules.far_behind;
  const bool is_of_curves =
      material::acts_in_measurement(fit.effects.front()) && evidence.observations.has(tester::TestKind::tensile);
  if (fit.effects.size() > 1 || !is_far_off || !is_of_curves) return fit;
  const bool found_nothing = std::abs(fit.u[evidence.base.fit.u.size()]) < rules.nothing;
  if (found >= rules.far_behind || found_nothing) fit = again_from(promising_initial_guess(evidence, fit));
  return fit;
}

Eigen::VectorXd best_initial_guess(const FeatureModel& model, const Observations& observations,
                                   const FittedModel& anchor, const Signature& signature, const FitRules& rules) {
  std::vector<std::string> names = anchor.effects;
  names.push_back(signature.effect);
  const CoordinateMap map = model.map(names);
  const Whitener whitener(observations.covariance());
  const Eigen::Index own = anchor.u.size();
  Eigen::VectorXd best = widened_start(anchor, map);
  double least = anchor.chi2;
  const std::vector<double> sizes = signed_sizes(rules.sizes, signature.one_sided);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    FittedModel shifted = anchor;
    shifted.predicted += signature.changes.col(static_cast<Eigen::Index>(i));
    Eigen::VectorXd step;
    const double chi2 = linear_refit(shifted, observations.values, whitener, &step);
    if (chi2 >= least) continue;
    least = chi2;
    best = widened_start(anchor, map);
    best.head(own) += step;
    best[own] = sizes[i];
  }
  // An initial guess of exactly zero may be a stationary point of an effect that begins quadratically.
  if (best[own] == 0.0) best[own] = rules.sizes.front();
  return best;
}

Evidence gather_evidence(Workbench& workbench, const DiagnosisSettings& settings) {
  Evidence evidence{workbench.model(), workbench.observations(), settings, {}, workbench.effects(), {}, {}, {}, {}};
  const CoordinateMap map = evidence.model.base_map();
  const double first = workbench.has_fractures() ? 0.55 : 0.0;
  const int passes = settings.floor.mesh_amplitude > 0.0 && evidence.observations.has(tester::TestKind::modulus)
                         ? 1 + settings.procedure.fit.mesh_passes
                         : 1;
  for (int pass = 0; pass < passes; ++pass) {
    if (pass > 0) share_discretisation(evidence);
    const double begin = first + (0.6 - first) * pass / passes, end = first + (0.6 - first) * (pass + 1) / passes;
    fit_models(evidence, pass == 0 ? map.coordinates(evidence.model.basis().centre) : evidence.base.fit.u,
               {begin, end});
    if (pass == 0) refine_fractures(evidence, workbench);
  }
  const Observations& observations = evidence.observations;
  if (settings.progress) settings.progress(0.7, "bootstrap of the base model");
  evidence.base.parts = parts_of_rows(observations);
  evidence.base_statistics = anchor_statistics(
      evidence.base, {observations.values, Whitener(observations.covariance())}, settings.procedure.names.imitated);
  evidence.base_draws = bootstrap_anchor(evidence.base, observations, settings.procedure.names.imitated,
                                         settings.bootstraps, settings.seed);
  return evidence;
}

Observations with_discretisation_at(const Evidence& evidence, const CoordinateMap& map, const Eigen::VectorXd& u) {
  Observations observations = evidence.observations;
  if (observations.has_shared_discretisation())
    observations.discretisation_shared = evidence.settings.floor.mesh_amplitude * evidence.model.mesh_change(map, u);
  return observations;
}

ProfileFit fit_with_own_discretisation(const Evidence& evidence, const std::vector<std::string>& effects,
                                       const Eigen::VectorXd& start, const std::vector<int>& held, double hopeless) {
  const auto fitted_from = [&](const Eigen::VectorXd& u) {
    const Observations observations = with_discretisation_at(evidence, evidence.model.map(effects), u);
    ProfileFit at{fit_model(evidence.model, observations, rules_of(evidence), effects, u, held)};
    const Eigen::LLT<Eigen::MatrixXd> factor(observations.covariance());
    at.deviance = at.fit.chi2 + 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    return at;
  };
  ProfileFit first = fitted_from(start);
  if (!evidence.observations.has_shared_discretisation() || first.deviance > hopeless) return first;
  return fitted_from(first.fit.u);
}

}  // namespace nacre::diagnosis
