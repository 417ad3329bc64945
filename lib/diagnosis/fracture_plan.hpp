#pragma once
// Fracture tests for a diagnosis that has a budget of simulations and does not simulate by itself: models that a
// calibration has evaluated cost nothing, effects take turns until the budget is spent.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"
#include "sysid/evaluated_model.hpp"
#include "sysid/wanted_evaluation.hpp"

namespace nacre::diagnosis {

/// What is to be simulated at once.
struct FracturePlan {
  std::vector<measurement::Replicates> measured;  ///< the fracture tests of the set, in the order of its groups
  std::vector<sysid::WantedEvaluation> wanted;    ///< of `measured`; in the first plan those evaluated come first
  material::ParameterSet centre;                  ///< the base model that they lie about
  std::vector<std::string> unaffordable;          ///< effects on fracture tests that the last plan cannot pay
};

/// With predictions in the order of `wanted` and of its items.
struct SimulatedPlan {
  FracturePlan plan;
  std::vector<std::vector<sysid::Prediction>> predictions;
};

/// The plan that follows those that are done. Three in all: what was evaluated, with the start and, where these are
/// few, base models about it; base models about the fit to what these teach; and about a further fit each effect at one
/// size, those first that moduli identify, then those that fracture tests show best, and in turns more base models and
/// sizes. Of a base model one group of each design is simulated, of an effect every group; what was evaluated costs
/// nothing. Nothing after the last, where there are no fracture tests, or where `simulations` do not pay for the first
/// two plans and the effects that moduli identify: without these fracture tests would stand in the way of what is
/// known.
std::optional<FracturePlan> next_fractures(const std::vector<measurement::SpecimenRecord>& specimens,
                                           const std::vector<sysid::EvaluatedModel>& evaluated, int simulations,
                                           const DiagnosisSettings& settings, const std::vector<SimulatedPlan>& done);

/// What these teach; at least one.
SimulatedFractures simulated_fractures(const std::vector<SimulatedPlan>& done);

}  // namespace nacre::diagnosis
