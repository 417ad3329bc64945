#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nacre {

/// "1 design", "2 designs"; `plural` where an s is not enough.
inline std::string counted(std::int64_t count, std::string_view singular, std::string_view plural = {}) {
  std::string words = std::to_string(count) + " ";
  if (count == 1 || plural.empty()) words += singular;
  if (count != 1) words += plural.empty() ? "s" : plural;
  return words;
}

}  // namespace nacre
