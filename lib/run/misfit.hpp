#pragma once
// Where calibration and diagnosis of one round disagree, for reports and views.

#include <string>

#include "run/run_record.hpp"

namespace nacre::run {

/// The misfit of the calibration's own fit where the diagnosis finds nothing wrong; empty where the two agree, or where
/// either is not known. They test different hypotheses: the game goes on with calibrated parameters, the diagnosis
/// tests whether any constants of the base model would do.
std::string misfit_beside_verdict(const RoundRecord& round);

}  // namespace nacre::run
