#pragma once
// The procedure of a diagnosis (docs/METHODS.md, "Diagnosis"), from specimens to verdict, gain and next tests.

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

/// Diagnoses a set of specimens: moduli and fracture tests of layouts, coupons with curves. Throws TooFewSpecimens when
/// fewer than eight groups of layouts have a valid test and fewer than four coupons, that differ in material, rate or
/// thickness (replicates count once), a curve; InputError when there are too few bootstraps for the level of a name.
Diagnosis diagnose(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
