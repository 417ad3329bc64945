#pragma once
// Fracture tests for a diagnosis that has a budget of simulations and does not simulate by itself: models that a
// calibration has evaluated cost nothing, effects take turns until the budget is spent.

#include <string>
#include <vector>

#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"
#include "sysid/evaluated_model.hpp"
#include "sysid/wanted_evaluation.hpp"

namespace nacre::diagnosis {

/// What is to be simulated.
struct FracturePlan {
  std::vector<measurement::Replicates> measured;  ///< the fracture tests of the set, in the order of its groups
  std::vector<sysid::WantedEvaluation> wanted;    ///< of `measured`; those that a calibration evaluated first
  std::vector<std::string> unaffordable;          ///< effects on fracture tests that the budget does not pay
  /// Whether the budget pays for base models enough, and for every effect that moduli tell of too: without these the
  /// fracture tests would stand in the way of what is known.
  bool pays() const { return !wanted.empty(); }
};

/// Each base model that is still missing and each effect costs one simulation of every fracture group, on top of what
/// was evaluated. In turns: base models up to a number, then each effect at one size, those first that moduli identify,
/// then those that fracture tests show best.
FracturePlan plan_fractures(const std::vector<measurement::SpecimenRecord>& specimens,
                            const std::vector<sysid::EvaluatedModel>& evaluated, int simulations,
                            const DiagnosisSettings& settings);

/// What the simulations of a plan teach: `predictions` in the order of `wanted` and of its items.
SimulatedFractures simulated_fractures(const FracturePlan& plan,
                                       const std::vector<std::vector<sysid::Prediction>>& predictions);

}  // namespace nacre::diagnosis
