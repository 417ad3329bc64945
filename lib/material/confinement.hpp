#pragma once
// Between plane stress and plane strain: the extension `plane_strain`.

#include "material/mixture.hpp"
#include "material/parameters.hpp"

namespace nacre::material {

/// Degree of plane strain at a thickness, 0 to 1: the extension's value at the standard 3.2 mm, nearer to 1 in thicker
/// specimens, t / (t + l) with the length l that gives the value at the standard thickness. 0 without the extension, at
/// any thickness.
double plane_strain_share(const Extensions& extensions, double thickness_mm);

/// Constants whose two-dimensional law has the same mu and lambda = lambda' + share (lambda3 - lambda'), lambda' being
/// that of plane stress (Eqs. 2.2, 2.3) and lambda3 = 2 mu nu / (1 - 2 nu) that of plane strain, nu at most 0.49: the
/// stress through the thickness is `share` of what no contraction at all would need. Exactly the same constants at 0.
Constants confined(const Constants& constants, double share);

}  // namespace nacre::material
