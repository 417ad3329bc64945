#pragma once
// Whether the specimens of a set may have been given in another unit.

#include <span>
#include <string>
#include <vector>

#include "material/parameters.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::offline {

/// Specimens that no model is so far from but by a mistaken unit.
struct SpecimenUnitDoubts {
  std::vector<std::string> first;  ///< a sentence on each of the first few
  std::string caution;             ///< how many there are, with a blank before it; empty: none
};

/// Some milliseconds per design: each modulus is simulated.
SpecimenUnitDoubts specimen_unit_doubts(std::span<const measurement::SpecimenRecord> specimens,
                                        const material::ParameterSet& model, tester::Fidelity fidelity);

}  // namespace nacre::offline
