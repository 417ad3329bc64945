#pragma once
// Data, forward model and emulator of one diagnosis.

#include <memory>

#include "diagnosis/fit.hpp"
#include "diagnosis/fracture_runs.hpp"
#include "diagnosis/model.hpp"
#include "diagnosis/settings.hpp"

namespace nacre::diagnosis {

/// Data, testers and emulator of one diagnosis, tied together.
class Workbench {
 public:
  /// Groups the specimens; where there are fracture tests finds the most probable eta and simulates around it. Throws
  /// TooFewSpecimens.
  Workbench(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings);
  Observations& observations() { return observations_; }
  const FeatureModel& model() const { return *model_; }
  const std::vector<std::string>& effects() const { return effects_; }
  bool has_fractures() const { return runs_ != nullptr; }
  const FractureRuns* runs() const { return runs_.get(); }
  /// Simulates the fracture tests at these parameters too and learns from them; the emulator's error in the data's
  /// covariance follows. Nothing to do without fracture tests. Returns the largest error of the emulator at the new
  /// points, in its own standard deviations.
  double refine(const std::vector<material::ParameterSet>& sets);
  /// The curve of a group at a fit: of the nearest run, machine included, or of the coupon; empty for a modulus.
  tester::Curve curve_at(int group, const FittedModel& fit) const;

 private:
  void simulate_around(const DiagnosisSettings& settings);
  void learn();

  Observations observations_;
  std::vector<std::string> effects_;  ///< that act on some row
  std::unique_ptr<FractureRuns> runs_;
  std::unique_ptr<FractureSurface> surface_;
  std::unique_ptr<FeatureModel> model_;
  tester::Fidelity fidelity_;
};

}  // namespace nacre::diagnosis
