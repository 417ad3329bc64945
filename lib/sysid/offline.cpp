#include "sysid/offline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/random.hpp"
#include "measurement/conditions.hpp"
#include "sysid/base_calibration.hpp"
#include "sysid/objective.hpp"
#include "sysid/weights.hpp"

namespace nacre::sysid {
namespace {

using measurement::Replicates;

struct Split {
  std::vector<Replicates> fitted, held_out, left_out;
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
  const auto is_pattern = [](const Replicates& each) { return each.design.layout() != nullptr; };
  split.base_materials = std::ranges::none_of(all, is_pattern);
  std::vector<Replicates> usable;
  for (const Replicates& each : all)
    (is_pattern(each) || (split.base_materials && is_base_material(each.design)) ? usable : split.left_out)
        .push_back(each);
  if (usable.empty())
    throw InputError(
        "the measurement set holds no valid modulus or toughness specimen of a pattern, of soft, rigid or interface, "
        "expected at least one");
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

/// Sum of logarithms and count of one quantity over the members.
struct LogMean {
  double sum = 0.0;
  int count = 0;
  void add(const std::optional<double>& value) {
    if (!value || *value <= 0.0) return;
    sum += std::log(*value);
    ++count;
  }
  std::optional<double> mean() const { return count > 0 ? std::optional(std::exp(sum / count)) : std::nullopt; }
};

}  // namespace

Calibrated run_calibration(const std::vector<Replicates>& measured, const CalibrationSettings& settings,
                           LocalSimulator& simulator, const ProgressCallback& progress,
                           const EvaluationObserver& observe) {
  const auto calibration = begin_calibration(measured, settings);
  while (!calibration->finished()) {
    const std::vector<WantedEvaluation> wanted = calibration->wanted();
    const double share = calibration->progress();
    const auto done = [&] {
      if (progress) progress(share, "calibrating");
    };
    const auto predictions = simulator.simulate(measured, wanted, done);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (observe) observe(wanted[k], predictions[k]);
      calibration->tell(k, predictions[k]);
    }
  }
  return calibration->result();
}

Calibrated calibrate_cheaply_first(const std::vector<Replicates>& measured, const CalibrationSettings& settings,
                                   LocalSimulator& cheaper, const DiscretisationFloor& cheaper_floor,
                                   LocalSimulator& simulator, const ProgressCallback& progress) {
  CalibrationSettings first = settings, second = settings;
  first.floor = cheaper_floor;
  first.searches = 1;
  first.strength_variation = false;
  first.ensemble_size =
      std::max(1, settings.batch) - 1;  // with the parameters themselves, the first batch of the second
  const Calibrated begun = run_calibration(measured, first, cheaper, progress);
  second.start = begun.parameters;
  second.other_starts = begun.ensemble;
  Calibrated result = run_calibration(measured, second, simulator, progress);
  // The errors before are those of the start that was given, not of where the second calibration began.
  const std::vector<Prediction> before = predict({settings.start}, measured, simulator).front();
  const std::vector<double> weights = settings.weights.empty() ? sample_weights(measured) : settings.weights;
  result.before = prediction_errors(measured, before);
  result.modulus_objective_before = modulus_objective(measured, weights, before);
  result.toughness_objective_before = toughness_objective(measured, weights, before);
  return result;
}

std::vector<std::vector<Prediction>> predict(const std::vector<material::ParameterSet>& parameters,
                                             const std::vector<Replicates>& measured, LocalSimulator& simulator,
                                             const std::function<void()>& done) {
  std::vector<WantedEvaluation> wanted;
  for (const material::ParameterSet& set : parameters) {
    WantedEvaluation modulus{"predicted", set, true, false, {}}, toughness{"predicted", set, false, true, {}};
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (measured[i].modulus_count > 0) modulus.items.push_back(i);
      if (measured[i].toughness_count > 0) toughness.items.push_back(i);
    }
    wanted.push_back(std::move(modulus));
    wanted.push_back(as_prediction(std::move(toughness)));
  }
  const auto simulated = simulator.simulate(measured, wanted, done);
  std::vector<std::vector<Prediction>> result;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    auto& predictions = result.emplace_back(measured.size());
    const auto& extensions = parameters[k].extensions;
    for (std::size_t i = 0; i < wanted[2 * k].items.size(); ++i) {
      const std::size_t item = wanted[2 * k].items[i];
      predictions[item].modulus_pa = observed(simulated[2 * k][i], extensions, measured[item]).modulus_pa;
    }
    for (std::size_t i = 0; i < wanted[2 * k + 1].items.size(); ++i) {
      const std::size_t item = wanted[2 * k + 1].items[i];
      Prediction shown = observed(simulated[2 * k + 1][i], extensions, measured[item]);
      Prediction& prediction = predictions[item];
      prediction.toughness_pa = shown.toughness_pa;
      prediction.curve = std::move(shown.curve);
    }
  }
  return result;
}

std::vector<Prediction> mean_prediction(const std::vector<std::vector<Prediction>>& members) {
  if (members.empty()) return {};
  std::vector<Prediction> result = members.front();
  for (std::size_t i = 0; i < result.size(); ++i) {
    LogMean modulus, toughness;
    for (const auto& member : members) {
      modulus.add(member[i].modulus_pa);
      toughness.add(member[i].toughness_pa);
    }
    result[i].modulus_pa = modulus.mean();
    result[i].toughness_pa = toughness.mean();
  }
  return result;
}

OfflineCalibration calibrate_offline(const measurement::MeasurementSet& set, const OfflineSettings& settings,
                                     const ProgressCallback& progress) {
  const Split split = split_set(set, settings);
  LocalSimulator simulator(settings.fidelity, settings.threads, settings.store);
  CalibrationSettings calibration = settings.calibration;
  OfflineCalibration result;
  result.base_materials = split.base_materials;
  if (split.base_materials) calibration.target = material::FitTarget::base;
  if (settings.begin_at && !split.base_materials) {
    std::filesystem::path store = settings.store;
    if (!store.empty()) store += fmt::format(".{}", tester::to_string(*settings.begin_at));
    LocalSimulator cheaper(*settings.begin_at, settings.threads, store);
    result.calibrated =
        calibrate_cheaply_first(split.fitted, calibration, cheaper, settings.begin_at_floor, simulator, progress);
    result.begun_simulations = cheaper.simulations();
  } else {
    result.calibrated = run_calibration(split.fitted, calibration, simulator, progress);
  }
  result.before_fitted = result.calibrated.before;
  result.after_fitted = result.calibrated.after;
  if (progress) progress(1.0, "predicting what was held out");
  std::vector<material::ParameterSet> sets = {calibration.start, result.calibrated.parameters};
  sets.insert(sets.end(), result.calibrated.ensemble.begin(), result.calibrated.ensemble.end());
  auto predictions = predict(sets, split.held_out, simulator);
  result.before_held_out = prediction_errors(split.held_out, predictions[0]);
  result.after_held_out = prediction_errors(split.held_out, predictions[1]);
  predictions.erase(predictions.begin());
  if (predictions.size() > 1)
    result.ensemble_held_out = prediction_errors(split.held_out, mean_prediction(predictions));
  result.measured = split.fitted;
  result.fitted = names_of(split.fitted);
  result.held_out = names_of(split.held_out);
  result.left_out = names_of(split.left_out);
  result.simulations = simulator.simulations();
  return result;
}

}  // namespace nacre::sysid
