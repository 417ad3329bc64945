#pragma once

#include <string>
#include <string_view>

namespace nacre::runtime {

/// Where two contents differ, for people: the field of a message, the same inside packed records (journal.hpp), else
/// the first byte. For contents that are not equal.
std::string content_difference(std::string_view recorded, std::string_view now);

}  // namespace nacre::runtime
