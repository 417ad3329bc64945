#pragma once

#include "measurement/measurement.hpp"

namespace nacre::measurement {

/// Reads a measurement set whose rows may lack every measured value: what is to be printed and tested. Otherwise as
/// read_measurement_set().
MeasurementSet read_planned_set(const std::filesystem::path& folder);

}  // namespace nacre::measurement
