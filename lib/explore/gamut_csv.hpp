#pragma once
// gamut.csv: index,pattern,rigid_fraction,modulus_pa,toughness_pa in order of evaluation, and where any T is the mean
// over specimens toughness_se_pa,specimens (docs/FORMATS.md).

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

std::string to_csv(std::span<const Evaluated> gamut);

/// Written whole or not at all. Throws InputError naming the file.
void write_gamut_csv(const std::filesystem::path& path, std::span<const Evaluated> gamut);

/// Reads a gamut: columns by name in any order, `pattern` (14 hex digits, each pattern once), `modulus_pa` and
/// `toughness_pa` (finite, not negative) required, `toughness_se_pa` (not negative) and `specimens` (from 1) where they
/// are there, others ignored; LF or CRLF, byte-order mark and quotes around a field allowed. Throws InputError naming
/// file, line, column and what was expected.
std::vector<Evaluated> read_gamut_csv(const std::filesystem::path& path);

/// The same from text; `source` names the place in errors.
std::vector<Evaluated> gamut_from_csv(std::string_view text, std::string_view source);

}  // namespace nacre::explore
