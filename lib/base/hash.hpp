#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nacre {

/// 128-bit content hash (XXH3) as 32 lower-case hex digits. Equal bytes, equal hash, on every machine.
std::string content_hash(std::string_view bytes);

/// 64-bit content hash (XXH3), for seeding named random streams.
std::uint64_t content_hash64(std::string_view bytes);

}  // namespace nacre
