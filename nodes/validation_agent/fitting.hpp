#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sysid/calibration.hpp"
#include "sysid/evaluated_model.hpp"

namespace nacre::validation_agent {

/// The fit in progress, of what was measured: of the base materials in round 0, of the calibration set later.
class Fitting {
 public:
  Fitting(std::vector<measurement::Replicates> measured, const sysid::CalibrationSettings& settings)
      : measured_(std::move(measured)), calibration_(sysid::begin_calibration(measured_, settings)) {}

  const std::vector<measurement::Replicates>& measured() const { return measured_; }
  const sysid::CalibrationProtocol& calibration() const { return *calibration_; }
  /// Predictions of all wanted evaluations, in their order.
  void tell(const std::vector<std::vector<sysid::Prediction>>& predictions) {
    const std::vector<sysid::WantedEvaluation> wanted = calibration_->wanted();
    for (std::size_t index = 0; index < predictions.size(); ++index) {
      calibration_->tell(index, predictions[index]);
      if (wanted[index].toughness && wanted[index].specimens == 1)
        evaluated_.push_back({wanted[index].parameters, wanted[index].first_specimen});
    }
  }
  /// Those of all that was told which broke one specimen of every design.
  const std::vector<sysid::EvaluatedModel>& evaluated() const { return evaluated_; }

 private:
  std::vector<measurement::Replicates> measured_;
  std::unique_ptr<sysid::CalibrationProtocol> calibration_;
  std::vector<sysid::EvaluatedModel> evaluated_;
};

}  // namespace nacre::validation_agent
