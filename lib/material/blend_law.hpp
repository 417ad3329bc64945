#pragma once
// The extension `blend_law`: homogeneous blends are stiffer or softer than the mixture law says (mixture.hpp), which
// stays exact at soft, interface and rigid material.

#include "material/parameters.hpp"

namespace nacre::material {

/// Factor on E of a blend: exp(b 4 t (1 - t)), t the way from one of the three materials to the next. 1 without the
/// extension.
double blend_factor(const Extensions& extensions, double rigid_fraction);

}  // namespace nacre::material
