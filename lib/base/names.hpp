#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// A name that is safe as a part of a path and in every message: ASCII letters, digits, - and _, and the characters of
/// `also` ('.'); 1 to `most_bytes`.
bool is_plain_name(std::string_view name, std::size_t most_bytes, std::string_view also = "");

/// N of an id that begins with `before`, the digits of N and `after`, as those of requests do: analyser/r2/measured.
std::optional<int> number_between(std::string_view before, std::string_view after, std::string_view id);

/// A control character of ASCII, which no label, line of a terminal or XML should hold.
inline bool is_control(char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; }

/// The text with ASCII capitals as small letters, whatever the locale.
std::string lower_case(std::string_view text);

}  // namespace nacre
