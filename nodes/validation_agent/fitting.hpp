#pragma once

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "sysid/base_calibration.hpp"
#include "sysid/calibration.hpp"

namespace nacre::validation_agent {

/// The fit in progress: of the base materials in round 0, of the calibration set later. Both speak the same protocol.
class Fitting {
 public:
  Fitting(std::vector<measurement::Replicates> measured, const sysid::CalibrationSettings& settings)
      : measured_(std::move(measured)), calibration_(make(measured_, settings)) {}

  const std::vector<measurement::Replicates>& measured() const { return measured_; }
  const std::vector<sysid::WantedEvaluation>& wanted() const {
    return std::visit(
        [](const auto& each) -> const auto& { return each.wanted(); }, calibration_);
  }
  /// Predictions of all wanted evaluations, in their order.
  void tell(const std::vector<std::vector<sysid::Prediction>>& predictions) {
    std::visit(
        [&](auto& each) {
          for (std::size_t index = 0; index < predictions.size(); ++index) each.tell(index, predictions[index]);
        },
        calibration_);
  }
  bool finished() const {
    return std::visit([](const auto& each) { return each.finished(); }, calibration_);
  }
  double progress() const {
    return std::visit([](const auto& each) { return each.progress(); }, calibration_);
  }
  const sysid::Calibrated& result() const {
    return std::visit(
        [](const auto& each) -> const auto& { return each.result(); }, calibration_);
  }

 private:
  using Either = std::variant<sysid::BaseCalibration, sysid::Calibration>;
  static Either make(const std::vector<measurement::Replicates>& measured, const sysid::CalibrationSettings& settings) {
    if (settings.target == material::FitTarget::base) return Either(std::in_place_index<0>, measured, settings);
    return Either(std::in_place_index<1>, measured, settings);
  }

  std::vector<measurement::Replicates> measured_;
  Either calibration_;
};

}  // namespace nacre::validation_agent
