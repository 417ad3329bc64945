#pragma once
// A hash of the procedure, so that two diagnoses can be compared.

#include <string>

#include "diagnosis/settings.hpp"

namespace nacre::diagnosis {

/// Content hash of how a verdict is reached, 16 hex digits: known effects with their ranges, features, contrasts,
/// levels, discretisation floor. Not in it: the data, the initial guess of the fit, the seed, and the budget of the
/// search.
std::string procedure_hash(const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
