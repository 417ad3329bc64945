#pragma once
// Gamuts of several searches as one.

#include <span>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// Several searches as one gamut, one after the other; of a pattern that several found the first sample stays.
std::vector<Evaluated> merge_gamuts(std::span<const std::vector<Evaluated>> gamuts);

}  // namespace nacre::explore
