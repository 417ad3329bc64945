#pragma once
// Which specimens a diagnosis includes.

#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

struct IncludedSpecimens {
  std::vector<measurement::SpecimenRecord> specimens;
  int fractures_left_out = 0;  ///< valid ones
};

/// Fracture tests are included when `fracture` asks for them, or when no other valid specimen would be: their
/// thresholds are not yet proven against the virtual laboratory. Moduli of homogeneous specimens alone are no reason to
/// leave them out where there are layouts.
IncludedSpecimens included_specimens(const std::vector<measurement::SpecimenRecord>& specimens, bool fracture);

}  // namespace nacre::diagnosis
