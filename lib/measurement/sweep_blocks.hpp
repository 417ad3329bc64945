#pragma once
// Second stage of reading a frequency sweep: lines -> tables with a column of frequency, or one frequency above
// them, and one of storage modulus; or of a relaxation, with a column of time and one of relaxation modulus, or of
// stress where no column tells a strain.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/import_fault.hpp"
#include "measurement/tester_blocks.hpp"

namespace nacre::measurement {

/// Finds the tables of a sweep, each with its heading, its units (in the heading, a row below or above, or each cell)
/// and its rows; rows without numbers are kept, means and deviations are not. No tables: the file is no sweep.
ExportTables sweep_tables_of(const std::vector<std::string_view>& lines);

/// Of a file that is neither a sweep nor a record of extension and force: why, where a heading names a storage modulus.
std::optional<ImportFault> fault_of_no_frequency(const std::vector<std::string_view>& lines, const std::string& file);

}  // namespace nacre::measurement
