#pragma once
// Writing specimens into measurement sets (docs/FORMATS.md).

#include <filesystem>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// Writes measurements.csv and curves/SPECIMEN.csv, or SPECIMEN~2.csv and so on where a file of that name exists: only
/// the table is overwritten. Throws InputError when the folder cannot be written.
void write_measurement_set(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens);

/// Adds specimens to the set in `folder`: their rows, in place of those of the same names, and curves in files of their
/// own; the rest stays. Throws InputError when the table cannot be read or a file cannot be written.
void add_to_measurement_set(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens);

}  // namespace nacre::measurement
