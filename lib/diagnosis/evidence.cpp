#include "diagnosis/evidence.hpp"

#include <algorithm>

#include "diagnosis/contrasts.hpp"
#include "diagnosis/factors.hpp"
#include "diagnosis/joint_fits.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/pairs.hpp"
#include "diagnosis/shared_discretisation.hpp"

namespace nacre::diagnosis {
namespace {

void report(const DiagnosisSettings& settings, double share, std::string_view phase) {
  if (settings.progress) settings.progress(share, phase);
}

/// Models whose change with finer elements is shared among moduli: the base, and every effect of the material that acts
/// on them.
Evidence with_shared_discretisation(Evidence evidence) {
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
  return evidence;
}

/// Fracture tests simulated at the base fit and at those of the effects that come nearest, until the emulator predicts
/// them.
Evidence with_refined_fractures(Evidence evidence) {
  if (evidence.fracture_groups.empty()) return evidence;
  const EmulatorRules& rules = evidence.settings.procedure.emulator;
  for (int pass = 0; pass < rules.refinements; ++pass) {
    std::vector<const FittedModel*> order;
    for (const FittedModel& single : evidence.singles) order.push_back(&single);
    std::ranges::stable_sort(order, {}, &FittedModel::chi2);
    order.resize(std::min(order.size(), static_cast<std::size_t>(rules.refined_effects)));
    std::vector<material::ParameterSet> sets = {evidence.base.fit.parameters};
    for (const FittedModel* fit : order) sets.push_back(fit->parameters);
    LearntData learnt = learnt_at(evidence, sets, rules);
    static_cast<Data&>(evidence) = std::move(learnt.data);
    const double begin = 0.6 + 0.03 * pass;
    evidence = with_fits(std::move(evidence), {begin, begin + 0.03});
    if (learnt.largest_error < rules.well_known) break;
  }
  return evidence;
}

/// Fits under the discretisation error of layouts on their own, then under that of the models fitted before.
Evidence fitted(const Data& data, const DiagnosisSettings& settings) {
  Evidence evidence{data, settings};
  const bool shares = settings.floor.mesh_amplitude > 0.0 && evidence.observations.has(tester::TestKind::modulus);
  const int passes = shares ? 1 + settings.procedure.fit.mesh_passes : 1;
  const double first = evidence.fractures ? 0.55 : 0.0;
  for (int pass = 0; pass < passes; ++pass) {
    if (pass > 0) evidence = with_shared_discretisation(std::move(evidence));
    const double begin = first + (0.6 - first) * pass / passes, end = first + (0.6 - first) * (pass + 1) / passes;
    evidence = with_fits(std::move(evidence), {begin, end});
    if (pass == 0) evidence = with_refined_fractures(std::move(evidence));
  }
  return evidence;
}

/// What the base does to data of its own, and how often chance does as much.
Evidence with_draws(Evidence evidence) {
  const Observations& observations = evidence.observations;
  const DiagnosisSettings& settings = evidence.settings;
  const double imitated = settings.procedure.names.imitated;
  report(settings, 0.7, "bootstrap of the base model");
  evidence.base.parts = parts_of_rows(observations);
  evidence.base_statistics =
      anchor_statistics(evidence.base, {observations.values, Whitener(observations.covariance())}, imitated);
  evidence.base_draws = bootstrap_anchor(evidence.base, observations, imitated, settings.bootstraps, settings.seed);
  return evidence;
}

/// With the factors that homogeneous specimens depend on; those that no effect knows get free levels, so that effects
/// are judged at equal temperature, humidity, age and machine.
Evidence with_factors(Evidence evidence, const Data& data) {
  const DiagnosisSettings& settings = evidence.settings;
  evidence.p_misfit = chance_of_base_misfit(evidence);
  if (evidence.p_misfit >= settings.procedure.levels.unexplained) return evidence;
  evidence.factors = factors_at_work(evidence.observations, evidence.base.fit, settings);
  if (evidence.factors.empty()) return evidence;
  const std::vector<std::string> levelled_factors = without_law(evidence.factors.front());
  if (levelled_factors.empty()) return evidence;
  Data levelled = data;
  levelled.observations.levels =
      level_directions(data.observations, levelled_factors, settings.procedure.noise.level_sd);
  Evidence within = with_draws(fitted(levelled, settings));
  within.factors = evidence.factors;
  within.without_levels = std::make_shared<const Evidence>(std::move(evidence));
  return within;
}

/// With the chances of the single effects: of their drops, and of their misfits where a name is in question.
Evidence with_chances(Evidence evidence) {
  evidence.p_misfit = chance_of_base_misfit(evidence);
  const std::vector<double> largest_drops = over_draws(evidence.base_draws, &DrawStatistics::largest_drop);
  evidence.p_family_wise.clear();
  for (const FittedModel& single : evidence.singles)
    evidence.p_family_wise.push_back(exceedance(largest_drops, evidence.base.fit.chi2 - single.chi2));
  evidence.p_fit.assign(evidence.singles.size(), 1.0);
  if (!is_noticed(evidence)) return evidence;
  report(evidence.settings, 0.8, "testing the residuals of each effect");
  // One far behind the best cannot be in the set: its misfit is not bootstrapped.
  const double in_reach = evidence.singles[best_single(evidence)].chi2 + evidence.settings.procedure.fit.far_behind;
  for (std::size_t k = 0; k < evidence.singles.size(); ++k)
    evidence.p_fit[k] = evidence.singles[k].chi2 <= in_reach ? chance_of_misfit(evidence, evidence.singles[k]) : 0.0;
  return evidence;
}

/// A second effect would only make up for the bound of one whose residuals are noise: no pairs then.
bool needs_pairs(const Evidence& evidence) {
  return is_noticed(evidence) && evidence.p_fit[best_single(evidence)] < evidence.settings.procedure.levels.unexplained;
}

}  // namespace

const Evidence& plain(const Evidence& evidence) {
  return evidence.without_levels ? *evidence.without_levels : evidence;
}

std::size_t best_single(const Evidence& evidence) {
  const auto best = std::ranges::min_element(evidence.singles, {}, &FittedModel::chi2);
  return static_cast<std::size_t>(best - evidence.singles.begin());
}

bool is_noticed(const Evidence& evidence) {
  return std::ranges::any_of(evidence.p_family_wise,
                             [&](double p) { return p <= evidence.settings.procedure.levels.name; });
}

bool is_usable(const FittedModel& fit, double p_fit, double level) { return p_fit >= level && !fit.extension_on_bound; }

Evidence gather_evidence(const Data& data, const DiagnosisSettings& settings) {
  Evidence evidence = with_chances(with_factors(with_draws(fitted(data, settings)), data));
  std::vector<PairsOnSingle> built;
  while (needs_pairs(evidence)) {
    report(settings, 0.9, "fitting pairs of effects");
    Pairs found = pairs_on_best(evidence, std::move(built));
    built = std::move(found.built);
    evidence.singles = std::move(found.singles);
    if (found.improved) {
      evidence = with_chances(std::move(evidence));
      continue;
    }
    evidence.pairs = std::move(found.pairs);
    for (const FittedModel& pair : evidence.pairs) evidence.p_pair_fit.push_back(chance_of_misfit(evidence, pair));
    break;
  }
  return evidence;
}

}  // namespace nacre::diagnosis
