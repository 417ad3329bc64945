#pragma once

#include <string>

#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

/// Content hash of everything that a verdict rests on beside the data and the start of the fit, 16 hex digits: the
/// library of effects with its ranges, features, contrasts, levels, what numerics leave.
std::string procedure_hash(const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
