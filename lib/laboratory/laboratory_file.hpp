#pragma once
// LAB.toml: read strictly, written back in full.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "laboratory/truth.hpp"

namespace nacre::laboratory {

/// Reads LAB.toml. Tables that it lacks are drawn from its seed, which is `seed` where the file names none. Throws
/// InputError naming file, line, key and what was expected.
Truth read_laboratory(const std::filesystem::path& path, std::uint64_t seed = 1);
/// The same from text; `source` names the place in errors.
Truth parse_laboratory(std::string_view toml, std::string_view source, std::uint64_t seed = 1);

/// The whole truth as TOML: parse_laboratory(to_toml(truth)) == truth.
std::string to_toml(const Truth& truth);

/// Writes the truth for the scoring program alone: mode 0400. Throws InputError.
void write_sealed(const std::filesystem::path& path, const Truth& truth);

}  // namespace nacre::laboratory
