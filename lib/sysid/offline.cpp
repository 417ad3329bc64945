#include "sysid/offline.hpp"

#include <algorithm>
#include <set>

#include "base/random.hpp"
#include "measurement/conditions.hpp"
#include "sysid/objective.hpp"

namespace nacre::sysid {
namespace {

using measurement::Replicates;

struct Split {
  std::vector<Replicates> fitted, held_out;
  bool base_materials = false;
};

std::vector<std::string> names_of(const std::vector<Replicates>& designs) {
  std::set<std::string> names;
  for (const Replicates& design : designs) names.insert(design.design.name());
  return {names.begin(), names.end()};
}

/// `count` of the names, chosen by the seed.
std::set<std::string> draw(std::vector<std::string> names, int count, std::uint64_t seed) {
  RandomStream random(seed, "hold-out");
  std::set<std::string> drawn;
  for (int k = 0; k < count; ++k) {
    const auto chosen = names.begin() + random.index(static_cast<int>(names.size()));
    drawn.insert(*chosen);
    names.erase(chosen);
  }
  return drawn;
}

Split split_set(const measurement::MeasurementSet& set, const OfflineSettings& settings) {
  Split split;
  const std::vector<Replicates> all = measurement::summarise(measurement::at_nominal_conditions(set.specimens));
  std::vector<Replicates> patterns;
  for (const Replicates& design : all) {
    if (design.design.layout() != nullptr) patterns.push_back(design);
  }
  split.base_materials = patterns.empty();
  const std::vector<Replicates>& usable = split.base_materials ? all : patterns;
  if (usable.empty())
    throw InputError("the measurement set holds no valid modulus or toughness specimen, expected at least one");
  const std::vector<std::string> names = names_of(usable);
  if (settings.hold_out < 0 || settings.hold_out >= static_cast<int>(names.size())) {
    throw InputError::format("cannot hold out {} of {} designs, expected at least one left to fit", settings.hold_out,
                             names.size());
  }
  const std::set<std::string> held = draw(names, settings.hold_out, settings.calibration.seed);
  for (const Replicates& design : usable)
    (held.contains(design.design.name()) ? split.held_out : split.fitted).push_back(design);
  return split;
}

/// Runs a calibration of either kind to its end.
template <class AnyCalibration>
Calibrated finish(AnyCalibration calibration, const std::vector<Replicates>& measured, LocalSimulator& simulator,
                  const ProgressCallback& progress) {
  while (!calibration.finished()) {
    const std::vector<WantedEvaluation> wanted = calibration.wanted();
    const double share = calibration.progress();
    const auto done = [&] {
      if (progress) progress(share, "calibrating");
    };
    const auto predictions = simulator.simulate(measured, wanted, done);
    for (std::size_t k = 0; k < wanted.size(); ++k) calibration.tell(k, predictions[k]);
  }
  return calibration.result();
}

PredictionErrors errors_with(const material::ParameterSet& parameters, const std::vector<Replicates>& measured,
                             LocalSimulator& simulator) {
  WantedEvaluation modulus{"held-out", parameters, true, false, {}}, toughness{"held-out", parameters, false, true, {}};
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i].modulus_count > 0) modulus.items.push_back(i);
    if (measured[i].toughness_count > 0) toughness.items.push_back(i);
  }
  const auto answers = simulator.simulate(measured, {modulus, toughness});
  std::vector<Prediction> predictions(measured.size());
  for (std::size_t k = 0; k < modulus.items.size(); ++k) {
    predictions[modulus.items[k]].modulus_pa = observed(answers[0][k], parameters.extensions).modulus_pa;
  }
  for (std::size_t k = 0; k < toughness.items.size(); ++k) {
    predictions[toughness.items[k]].toughness_pa = observed(answers[1][k], parameters.extensions).toughness_pa;
  }
  return prediction_errors(measured, predictions);
}

}  // namespace

OfflineCalibration calibrate_offline(const measurement::MeasurementSet& set, const OfflineSettings& settings,
                                     const ProgressCallback& progress) {
  const Split split = split_set(set, settings);
  LocalSimulator simulator(settings.fidelity, settings.threads);
  CalibrationSettings calibration = settings.calibration;
  OfflineCalibration result;
  result.base_materials = split.base_materials;
  if (split.base_materials) {
    calibration.target = material::FitTarget::base;
    result.calibrated = finish(BaseCalibration(split.fitted, calibration), split.fitted, simulator, progress);
  } else {
    result.calibrated = finish(Calibration(split.fitted, calibration), split.fitted, simulator, progress);
  }
  result.before_fitted = result.calibrated.before;
  result.after_fitted = result.calibrated.after;
  if (progress) progress(1.0, "predicting what was held out");
  result.before_held_out = errors_with(calibration.start, split.held_out, simulator);
  result.after_held_out = errors_with(result.calibrated.parameters, split.held_out, simulator);
  result.fitted = names_of(split.fitted);
  result.held_out = names_of(split.held_out);
  result.simulations = simulator.simulations();
  return result;
}

}  // namespace nacre::sysid
