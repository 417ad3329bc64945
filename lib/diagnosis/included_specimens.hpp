#pragma once

#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

/// What takes part in a diagnosis, and what is to be said of the rest.
struct IncludedSpecimens {
  std::vector<measurement::SpecimenRecord> specimens;
  std::string left_out;  ///< sentences with a space in front; empty: nothing is
};

/// Fracture tests take part when `fracture` asks for them, or when no valid specimen would take part beside them: their
/// thresholds are not yet proven against the virtual laboratory. Of homogeneous moduli that observe() leaves out it is
/// said that they are.
IncludedSpecimens included_specimens(const std::vector<measurement::SpecimenRecord>& specimens, bool fracture);

}  // namespace nacre::diagnosis
