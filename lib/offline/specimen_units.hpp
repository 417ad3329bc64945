#pragma once
// Whether the specimens of a set may have been given in another unit.

#include <span>
#include <string>
#include <vector>

#include "material/parameters.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::offline {

/// What is expected of specimens: the bulk of homogeneous ones has constants of its own (thesis 3.2.4).
struct ExpectedMaterials {
  material::ParameterSet of_layouts, of_homogeneous;
};

/// Specimens that no model is so far from but by a mistaken unit.
struct SpecimenUnitDoubts {
  std::vector<std::string> first;  ///< a sentence on each of the first few
  std::string caution;             ///< how many there are, with a blank before it; empty: none
};

/// Doubts about specimens that nothing else of the set vouches for: another specimen of the same design and kind of
/// test that measured much the same, or the model fitted to the set. A material far from the inks is another material,
/// not a wrong unit. Some milliseconds per design: each modulus is simulated.
SpecimenUnitDoubts specimen_unit_doubts(std::span<const measurement::SpecimenRecord> specimens,
                                        const ExpectedMaterials& expected, tester::Fidelity fidelity);

}  // namespace nacre::offline
