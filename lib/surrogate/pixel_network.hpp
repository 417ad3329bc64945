#pragma once
// A feature that stiffness and fracture both hang on: how well the rigid pixels are connected along the pull.

#include "pattern/layout.hpp"

namespace nacre::surrogate {

/// Natural logarithm of the conductance of the pattern as a network of pixels, soft ones conducting `soft_conductivity`
/// (in (0, 1]) times as well as rigid ones: 0 when all is rigid, log(soft_conductivity) when all is soft. The quarter
/// suffices: by symmetry the mirror lines across the pull are equipotential, those along it are not crossed. A scalar
/// stand-in for the modulus, 10 us each.
double log_conductance(const pattern::Pattern& pattern, double soft_conductivity);

}  // namespace nacre::surrogate
