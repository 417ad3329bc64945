#pragma once

#include "pattern/layout.hpp"

namespace nacre::pattern {

/// The pattern of a key. The error says what was expected, also for a layout without the eightfold symmetry.
Result<Pattern> pattern_from_key(std::string_view key);

}  // namespace nacre::pattern
