#pragma once
// provenance.csv of a measurement set: which file, part, columns, units and decisions each number came from.

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "measurement/import.hpp"
#include "measurement/specimen_sheet.hpp"

namespace nacre::measurement {

inline constexpr const char* kProvenanceName = "provenance.csv";

/// Writes a row per imported specimen into the set `folder`; rows of its other specimens stay. Throws InputError when
/// the file cannot be read or written.
void write_provenance(const std::filesystem::path& folder, std::span<const ImportedSpecimen> specimens);

/// Cells that every specimen has: part, maker, encoding, delimiter, decimal mark, first and last line, sizes.
std::map<std::string, std::string> provenance_of_file(const TesterRecord& from, const SheetRow& row);

/// Adds the cells of the column that was taken for `quantity`, if one was.
void add_provenance(std::string_view quantity, const std::optional<TakenColumn>& column,
                    std::map<std::string, std::string>& cells);

}  // namespace nacre::measurement
