#include "true_gain.hpp"

#include <limits>

#include "diagnosis/gain.hpp"
#include "laboratory/effect_kinds.hpp"

namespace nacre::blind_trials {
namespace {

namespace fs = std::filesystem;
using namespace diagnosis;

/// The hidden effects at their hidden sizes, base constants fitted from those of the base fit.
FittedModel true_model(const Evidence& evidence, const laboratory::Truth& truth,
                       const std::vector<std::string>& hidden) {
  const CoordinateMap map = evidence.model.map(hidden);
  Eigen::VectorXd start = widened_start(evidence.base.fit, map);
  std::vector<int> held;
  for (const laboratory::EffectKind& kind : laboratory::effect_kinds()) {
    const auto place = std::ranges::find(map.effects(), kind.name);
    if (place == map.effects().end()) continue;
    const auto parameters = material::find_effect(kind.name)->parameters;
    std::vector<double> values = {truth.effects.*kind.value};
    if (kind.second.value) values.push_back(truth.effects.*kind.second.value);
    for (std::size_t p = 0; p < std::min(values.size(), parameters.size()); ++p) {
      held.push_back(map.first_coordinate(static_cast<std::size_t>(place - map.effects().begin())) +
                     static_cast<int>(p));
      start[held.back()] = material::strength_of(parameters[p], values[p]);
    }
  }
  return fit_model(evidence.model, evidence.observations, evidence.settings.procedure.fit, map.effects(), start, held);
}

/// Share of the errors of all features that is gone, each in units of its noise.
double reduction_of_features(const Gain& gain) {
  double before = 0.0, after = 0.0;
  for (const FeatureGain& f : gain.features) before += f.before / f.noise, after += f.after / f.noise;
  return before > 0.0 ? 1.0 - after / before : 0.0;
}

}  // namespace

TrueGain true_gain(const BlindTrial& trial, const TrialOptions& options, const fs::path& folder) {
  if (!fs::exists(folder / "set")) generate(trial, options, folder);
  DiagnosisSettings settings;
  settings.start = material::default_parameters();
  settings.fidelity = options.fidelity;
  settings.floor = read_modulus_floor(NACRE_SOURCE_DIR "/data/discretisation_floor.toml", options.fidelity);
  settings.fracture_discretisation =
      read_fracture_discretisation(NACRE_SOURCE_DIR "/data/discretisation_floor.toml", options.fidelity);
  const Evidence evidence =
      gather_evidence(data_of(measurement::read_measurement_set(folder / "set").specimens, settings), settings);
  const auto gain_among = [&](const std::vector<FittedModel>& models, double least_drop) {
    return held_out_gain(evidence.observations, evidence.base.fit, {.models = models, .least_drop = least_drop},
                         trial.hidden, settings.procedure.gain, settings.seed);
  };
  const Gain named = gain_among(evidence.singles, drop_needed(evidence)),
             truth = gain_among({true_model(evidence, truth_of(trial, options), trial.hidden)},
                                -std::numeric_limits<double>::infinity());
  return {named.relative_reduction, truth.relative_reduction, reduction_of_features(named),
          reduction_of_features(truth)};
}

}  // namespace nacre::blind_trials
