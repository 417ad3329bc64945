#pragma once
// The table of effects: names, units, ranges, the tests in which each acts, and a sentence about it.

#include "material/extensions.hpp"

namespace nacre::material {

/// All effects that the model can be extended by, in a fixed order.
std::span<const Effect> effect_library();

}  // namespace nacre::material
