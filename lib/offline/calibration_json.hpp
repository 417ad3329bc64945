#pragma once
// The JSON document of `nacre calibrate --json` (docs/FORMATS.md), but for `rejected`.

#include <nlohmann/json.hpp>

#include "sysid/offline.hpp"

namespace nacre::offline {

nlohmann::ordered_json to_json(const sysid::OfflineCalibration& result);

}  // namespace nacre::offline
