#pragma once
// How large the specimens of each fidelity are. Testers and virtual laboratory measure the same geometry.

#include "tester/tester.hpp"

namespace nacre::tester {

/// Units (repeated tiles of 20 x 20 pixels) of a specimen along x and y.
struct SpecimenUnits {
  int x = 0;
  int y = 0;
};

/// The notched specimen: 5 x 4 in full (Figure 2-5A), 3 x 2 in preview, one in tiny.
SpecimenUnits toughness_units(Fidelity fidelity);

/// The modulus specimen: 2 x 1 (Figure 2-5B), one in tiny.
SpecimenUnits modulus_units(Fidelity fidelity);

}  // namespace nacre::tester
