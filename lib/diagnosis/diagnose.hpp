#pragma once
// The procedure of a diagnosis (docs/METHODS.md, "Diagnosis"), from specimens to verdict, gain and next tests.

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

/// Diagnoses a set of specimens: moduli and fracture tests of layouts, moduli of homogeneous specimens, coupons with
/// curves. Throws NothingMeasured where there are none; InputError when there are too few bootstraps for the level of a
/// name.
Diagnosis diagnose(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings);

/// The same; `insufficient` where there is no row to diagnose.
Diagnosis diagnose_or_say_why_not(const std::vector<measurement::SpecimenRecord>& specimens,
                                  const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
