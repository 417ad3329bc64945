#pragma once
// Base64 (RFC 4648, section 4): bytes in the letters that addresses and JSON can hold.

#include <optional>
#include <string>
#include <string_view>

namespace nacre {

std::string base64(std::string_view bytes);

/// The bytes of a text in base64, padded, without white space; nothing for any other text.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace nacre
