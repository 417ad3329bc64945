#pragma once

#include <string>

#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

/// Content hash of how a verdict is reached, 16 hex digits: the library of effects with its ranges, features,
/// contrasts, levels, what numerics leave. Not in it: the data, the start of the fit, the seed, and how many
/// simulations the search may spend.
std::string procedure_hash(const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
