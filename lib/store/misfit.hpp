#pragma once
// Where calibration and diagnosis of one round disagree, for reports and views.

#include <string>

#include "store/run_record.hpp"

namespace nacre::store {

/// What the calibration's own fit says against a diagnosis that finds nothing wrong; empty where the two agree, or
/// where either is not known. The two ask different questions: the game goes on with calibrated parameters, the
/// diagnosis asks whether any constants of the base model would do.
std::string misfit_beside_verdict(const RoundRecord& round);

}  // namespace nacre::store
