#pragma once
// The message types as data, read from the .lcm files that the library was built with. A walk over the bytes of a
// message by its type makes decoding safe, prints any message, and names the field in which two messages differ.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/result.hpp"

namespace nacre::wire {

/// No message is longer, so that each is one datagram (fragments multiply loss).
inline constexpr std::size_t kMaximumPayload = 60'000;
/// Longest message without its header: leaves room for the names in it.
inline constexpr std::size_t kMaximumBlankPayload = kMaximumPayload - 500;
/// Longest text inside a message.
inline constexpr std::size_t kMaximumText = 4096;

/// Walks `payload` (fingerprint first) as a message of `type`: every count, length, zero-terminated text, truth value
/// (0 or 1) and number (finite) must be in order and the bytes must end where the message ends. The fingerprint itself
/// is not compared. Takes no memory that the payload asks for. The error names the field.
Result<void> check_structure(std::string_view type, std::string_view payload);

/// The message as JSON, members in the order of the type, arrays as arrays.
Result<nlohmann::ordered_json> to_json(std::string_view type, std::string_view payload);

/// "designs[3].modulus_pa: 1.5e+09 against 1.6e+09" for the first field that differs; nothing when none does. Bytes
/// that cannot be read as `type` are reported as such.
std::optional<std::string> first_difference(std::string_view type, std::string_view expected, std::string_view actual);

}  // namespace nacre::wire
