#pragma once
// Sentences on what an extended model gains.

#include <string>

#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

/// The gain of a named effect on designs that the fit has not seen, in a sentence: errors as per cent of E and T, and a
/// gain (or a loss) only where the 90 % interval leaves no doubt of its sign. A cause may be sure and its gain not: the
/// base imitates most of it there.
std::string gain_in_words(const Gain& gain);

/// Whether the choice of designs changes, in a sentence for each of E and T; empty where no two designs differ by
/// enough.
std::string choice_in_words(const Gain& gain);

}  // namespace nacre::diagnosis
