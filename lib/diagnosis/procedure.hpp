#pragma once

#include <string>

#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

/// Everything that a verdict rests on beside the data, as text: the library of effects with its ranges, features,
/// contrasts, levels.
std::string procedure_text(const DiagnosisSettings& settings);

/// Content hash of that text, 16 hex digits.
std::string procedure_hash(const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
