#pragma once

#include <cstddef>
#include <string_view>

namespace nacre {

/// A name that is safe as a part of a path and in every message: ASCII letters, digits, - and _, and what of `also`
/// ('.') is allowed beside them; 1 to `most_bytes`.
bool is_plain_name(std::string_view name, std::size_t most_bytes, std::string_view also = "");

}  // namespace nacre
