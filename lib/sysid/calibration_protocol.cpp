#include "sysid/calibration_protocol.hpp"

#include <utility>

#include "sysid/base_calibration.hpp"
#include "sysid/calibration.hpp"

namespace nacre::sysid {

std::unique_ptr<CalibrationProtocol> begin_calibration(std::vector<measurement::Replicates> measured,
                                                       const CalibrationSettings& settings) {
  if (settings.target == material::FitTarget::base)
    return std::make_unique<BaseCalibration>(std::move(measured), settings);
  return std::make_unique<Calibration>(std::move(measured), settings);
}

}  // namespace nacre::sysid
