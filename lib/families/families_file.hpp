#pragma once
// families.toml, in which a person edits the proposed families (docs/FORMATS.md).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "families/grouping.hpp"

namespace nacre::families {

inline constexpr std::size_t kLongestFamilyName = 64;  ///< bytes

/// Letters, digits, - and _ (folders are named after families), not digits alone: those mean a round.
bool is_family_name(std::string_view name);

/// families.toml: `[[family]] name, seeds = ["key", ...]`.
std::string to_toml(const std::vector<SeedFamily>& families);
/// Reads it back. Throws InputError naming file, line and what was expected: a name (letters, digits, - and _; each
/// once) and at least one pattern key; a pattern belongs to one family.
std::vector<SeedFamily> read_families(const std::filesystem::path& file);
/// The same from text; `source` names the place in errors.
std::vector<SeedFamily> parse_families(std::string_view text, const std::string& source);

}  // namespace nacre::families
