#pragma once

#include <string>

namespace nacre::runtime {

/// "nacre 0.1.0, commit 0123456789ab, kernel 7, messages 1": programs that say the same understand each other.
std::string version_in_words();

}  // namespace nacre::runtime
