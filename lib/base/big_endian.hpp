#pragma once
// Whole numbers as LCM writes them: the highest byte first.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace nacre {

/// Appends the low `size` bytes of a number, 1 to 8.
inline void append_big_endian(std::string& bytes, std::uint64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
}

/// The number that `bytes` hold, 1 to 8 of them.
inline std::uint64_t read_big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<std::uint8_t>(byte);
  return value;
}

}  // namespace nacre
