#include <algorithm>
#include <cmath>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {
namespace {

/// How often the directions of the numerics are computed anew at models fitted with them.
constexpr int kMeshPasses = 2;
/// Shares of an effect's range at which its signature is computed: effects may start quadratically, so more than one is needed.
constexpr double kSizes[] = {0.03, 0.1, 0.3, 0.6};

/// Effects whose traces in E are calibrated against the numerics so far; the others stay out of the comparison.
bool tells_on_modulus(std::string_view name) {
  return name == "interface_anisotropy" || name == "droplet_mixing" || name == "machine_compliance";
}

std::vector<std::string> modulus_effects() {
  std::vector<std::string> names;
  for (const material::Effect& effect : material::effect_library()) {
    if (effect.acts_on_modulus && tells_on_modulus(effect.name)) names.emplace_back(effect.name);
  }
  return names;
}

/// The model with `added` after the effects of `fit`, at the same coordinates and with the added parameters at zero.
Eigen::VectorXd widened_start(const Fit& fit, const CoordinateMap& map) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(map.size());
  u.head(fit.u.size()) = fit.u;
  return u;
}

/// Start for a joint fit: the size of the effect whose signature lowers the misfit most.
Eigen::VectorXd best_start(const Evidence& evidence, std::size_t effect) {
  const CoordinateMap map(std::vector<std::string>{evidence.effects[effect]});
  const Eigen::VectorXd y = evidence.observations.log_moduli();
  const Whitener whitener(evidence.observations.covariance());
  Eigen::VectorXd best = widened_start(evidence.base.fit, map);
  double least = evidence.base.fit.chi2;
  std::size_t index = 0;
  const Signature& signature = evidence.base.signatures[effect];
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0.0 && signature.one_sided) continue;
    for (const double size : kSizes) {
      Fit shifted = evidence.base.fit;
      shifted.predicted += signature.changes[index++];
      Eigen::VectorXd step;
      const double chi2 = linear_refit(shifted, y, whitener, &step);
      if (chi2 >= least) continue;
      least = chi2;
      best = widened_start(evidence.base.fit, map);
      best.head(kBaseCount) += step.head(kBaseCount);
      best[kBaseCount] = sign * size;
    }
  }
  // A start at exactly zero may be a stationary point of an effect that begins quadratically.
  if (best[kBaseCount] == 0.0) best[kBaseCount] = kSizes[0];
  return best;
}

/// Shares of the whole work between which a step lies.
struct Stretch {
  double begin = 0.0, end = 1.0;
};

/// Base and every single effect, fitted to the observations of the evidence.
void fit_models(Evidence& evidence, const Eigen::VectorXd& start, Stretch stretch) {
  const auto report = [&](double share, std::string_view phase) {
    if (evidence.settings.progress) evidence.settings.progress(stretch.begin + share * (stretch.end - stretch.begin), phase);
  };
  report(0.0, "fitting the base model");
  evidence.base.fit = fit_model(evidence.model, evidence.observations, {}, start);
  report(0.3, "signatures of the effects");
  evidence.base.signatures = signatures_on(evidence.model, evidence.base.fit, evidence.effects);
  evidence.base.directions = contrast_directions(evidence.observations, evidence.base.fit.predicted);
  evidence.singles.clear();
  for (std::size_t k = 0; k < evidence.effects.size(); ++k) {
    report(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(evidence.effects.size()), "fitting base and " + evidence.effects[k]);
    evidence.singles.push_back(fit_model(evidence.model, evidence.observations, {evidence.effects[k]}, best_start(evidence, k)));
  }
}

/// What finer elements would change, at the base fit, and what they would change otherwise were an effect of the material true: each
/// direction with a factor of its own, because an effect that smooths or sharpens a layout changes what its elements cost.
void share_numerics(Evidence& evidence) {
  const double amplitude = evidence.settings.floor.mesh_amplitude;
  std::vector<Eigen::VectorXd> directions = {amplitude * evidence.model.mesh_change(evidence.base.fit.parameters)};
  for (const Fit& single : evidence.singles) {
    if (material::find_effect(single.effects.front())->side != material::EffectSide::material) continue;
    directions.push_back(amplitude * evidence.model.mesh_change(single.parameters) - directions.front());
  }
  Eigen::MatrixXd& shared = evidence.observations.numerics_shared;
  shared.resize(evidence.observations.size(), static_cast<Eigen::Index>(directions.size()));
  for (std::size_t k = 0; k < directions.size(); ++k) shared.col(static_cast<Eigen::Index>(k)) = directions[k];
  evidence.observations.numerics_sd = evidence.settings.floor.mesh_remainder_sd;
}

}  // namespace

std::vector<Signature> signatures_on(const ModulusModel& model, const Fit& anchor, const std::vector<std::string>& effects) {
  std::vector<Signature> signatures;
  for (const std::string& effect : effects) {
    std::vector<std::string> names = anchor.effects;
    names.push_back(effect);
    const CoordinateMap map(names);
    const int own = static_cast<int>(anchor.u.size());
    Signature signature{effect, {}, map.lower(own) >= 0.0};
    std::vector<material::ParameterSet> sets;
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0.0 && signature.one_sided) continue;
      for (const double size : kSizes) {
        Eigen::VectorXd u = widened_start(anchor, map);
        u[own] = sign * size;
        sets.push_back(map.parameters(u));
      }
    }
    const Eigen::MatrixXd predicted = model.predict(sets);
    for (Eigen::Index i = 0; i < predicted.cols(); ++i) signature.changes.emplace_back(predicted.col(i) - anchor.predicted);
    signatures.push_back(std::move(signature));
  }
  return signatures;
}

Evidence gather_evidence(const ModulusModel& model, const Observations& measured, const DiagnosisSettings& settings) {
  Evidence evidence{model, measured, settings, {}, modulus_effects(), {}, {}, {}};
  const CoordinateMap map(std::span<const std::string>{});
  const int passes = settings.floor.mesh_amplitude > 0.0 ? 1 + kMeshPasses : 1;
  for (int pass = 0; pass < passes; ++pass) {
    if (pass > 0) share_numerics(evidence);
    fit_models(evidence, pass == 0 ? map.coordinates(settings.start.modulus) : evidence.base.fit.u, {0.7 * pass / passes, 0.7 * (pass + 1) / passes});
  }
  const Observations& observations = evidence.observations;
  if (settings.progress) settings.progress(0.7, "bootstrap of the base model");
  evidence.base_statistics = anchor_statistics(evidence.base, {observations.log_moduli(), Whitener(observations.covariance())});
  evidence.base_draws = bootstrap_anchor(evidence.base, observations, settings.bootstraps, settings.seed);
  return evidence;
}

}  // namespace nacre::diagnosis
