#pragma once
// Measurement sets: a folder with measurements.csv and the curve files that it names (docs/FORMATS.md). Rows are
// independent: what is wrong with one is reported, and the others are kept.

#include <filesystem>
#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

struct MeasurementSet {
  std::vector<SpecimenRecord> specimens;  ///< in the order of the file
  std::vector<int> lines;                 ///< of each specimen in the table
  std::vector<RejectedRow> rejected;
  std::vector<std::string> warnings;
};

/// Reads a measurement set. Throws InputError when the folder or the table cannot be read or no row is usable.
MeasurementSet read_measurement_set(const std::filesystem::path& folder);

/// The same for computations with the values: valid rows outside kModulusPa and kToughnessPa are rejected too, for one
/// modulus in GPa distorts a whole fit. Throws InputError also when no row is left.
MeasurementSet read_plausible_set(const std::filesystem::path& folder);

/// The same for a set whose rows may lack every measured value: what is to be printed and tested.
MeasurementSet read_planned_set(const std::filesystem::path& folder);

}  // namespace nacre::measurement
