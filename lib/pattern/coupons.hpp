#pragma once
// Layouts without the symmetry of patterns, for verification and for experiments that tell causes apart.

#include "pattern/layout.hpp"

namespace nacre::pattern {

/// Which way the layers of a laminate run: along_x across the pull (loaded in series), along_y with the pull (in
/// parallel).
enum class LayerDirection { along_x, along_y };

/// Layers of `rigid_pixels` and `soft_pixels` in turn, rigid first (from the top, or from the left). Throws InputError
/// unless both are at least 1 and their sum divides 20, so that the layers also alternate across the edges of the unit.
Layout laminate(LayerDirection direction, int rigid_pixels, int soft_pixels);

/// Squares of `period` pixels, the one in the upper left corner rigid. Throws InputError unless period is 1, 2, 5
/// or 10.
Layout checkerboard(int period);

}  // namespace nacre::pattern
