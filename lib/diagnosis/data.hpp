#pragma once
// The data of a diagnosis with the forward model that predicts them.

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/fit.hpp"
#include "diagnosis/fracture_tests.hpp"
#include "diagnosis/model.hpp"
#include "diagnosis/settings.hpp"

namespace nacre::diagnosis {

struct Data {
  Observations observations;                       ///< with the error of the emulator
  std::shared_ptr<const FractureTests> fractures;  ///< nothing: there are none, or others simulated them
  std::vector<int> fracture_groups;                ///< that the model is to learn: fracture tests
  std::vector<FractureRun> runs;                   ///< that the model's surface has learnt from
  FeatureModel model;
  std::vector<std::string> effects;  ///< that act on some row: candidates, in the order of material::effect_library()
};

/// Groups the specimens; where there are fracture tests finds the most probable eta and simulates around it. Throws
/// NothingMeasured.
Data data_of(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings);

/// Effects that have a signature in these rows, in the order of material::effect_library(). Of what others simulated
/// without an effect nothing is known about it: none where fracture tests are among the rows.
std::vector<std::string> acting_effects(const FeatureModel& model, const Observations& observations,
                                        const DiagnosisSettings& settings);

/// Data whose fracture tests were simulated at further parameters, with the emulator that has learnt from them; its
/// error is that at the first of them.
struct LearntData {
  Data data;
  double largest_error = 0.0;  ///< of the emulator before, at the new points, in its own standard deviations
};
LearntData learnt_at(const Data& data, const std::vector<material::ParameterSet>& sets, const EmulatorRules& rules);

/// The curve of a group at a fit: of the nearest run, machine included, or of the coupon; empty for a modulus.
tester::Curve curve_at(const Data& data, int group, const FittedModel& fit);

}  // namespace nacre::diagnosis
