#pragma once

#include "pattern/layout.hpp"

namespace nacre::pattern {

/// The pattern of a key. The error says what was expected, of a layout without the eightfold symmetry too.
Result<Pattern> pattern_from_key(std::string_view key);

}  // namespace nacre::pattern
