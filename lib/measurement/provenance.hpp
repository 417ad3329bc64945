#pragma once
// provenance.csv of a measurement set: which file, part, columns, units and decisions each number came from.

#include <filesystem>
#include <span>

#include "measurement/import.hpp"

namespace nacre::measurement {

inline constexpr const char* kProvenanceName = "provenance.csv";

/// Writes a row per imported specimen into the set `folder`; rows of its other specimens stay. Throws InputError when
/// the file cannot be read or written.
void write_provenance(const std::filesystem::path& folder, std::span<const ImportedSpecimen> specimens);

}  // namespace nacre::measurement
