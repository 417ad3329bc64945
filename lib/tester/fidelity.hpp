#pragma once

#include "tester/names.hpp"
// The fidelities: size and loading rate of the specimens, for the testers and the virtual laboratory alike.

namespace nacre::tester {

/// Units (repeated tiles of 20 x 20 pixels) of a specimen along x and y.
struct SpecimenUnits {
  int x = 0;
  int y = 0;
};

/// The notched specimen: 5 x 4 in full and in preview (Figure 2-5A), one in tiny.
SpecimenUnits toughness_units(Fidelity fidelity);

/// Factor on the strain rate of the fracture test (20 /s, 2.3.1): 2 in preview, else 1. A faster pull ranks designs far
/// better than a smaller specimen that costs the same (docs/studies/fidelity.md).
double loading_rate_scale(Fidelity fidelity);

/// Elements along one side of a thesis element (half a pixel): 2 in fine, else 1. Discretisation::refinement comes on
/// top.
int refinement_of(Fidelity fidelity);

/// The modulus specimen: 2 x 1 (Figure 2-5B), one in tiny.
SpecimenUnits modulus_units(Fidelity fidelity);

}  // namespace nacre::tester
