#pragma once
// Third stage of reading an export: tables -> parts, each the record of one specimen.

#include <optional>
#include <string>
#include <vector>

#include "measurement/tester_blocks.hpp"
#include "measurement/tester_series.hpp"

namespace nacre::measurement {

/// One specimen of a file.
struct TesterPart {
  std::string name;                  ///< as the file names it; else its number
  std::size_t heading = 0;           ///< index of the line of its heading
  std::vector<std::size_t> columns;  ///< of the table that are the specimen's
  ColumnSeries series;               ///< empty where there is a fault
  std::optional<ImportFault> fault;  ///< why it cannot be used
};

struct ExportParts {
  std::vector<TesterPart> parts;
  std::vector<std::string> notes;  ///< what was left out of the file, as sentences
};

/// Columns of specimens beside each other: of headings that occur again, or that differ by a number or a letter alone.
struct ColumnGroup {
  std::string name;  ///< empty: the table holds one specimen
  std::vector<std::size_t> columns;
  bool shares_extension = false;  ///< with the other groups
};
std::vector<ColumnGroup> column_groups(const TableBlock& block, const ColumnChoice& choice);

/// Splits tables where a column names another specimen, where a title stands between, and where extension, force and
/// clock begin again; joins tables whose clock and extension go on (headings on every page, blocks of MTS 793). Leaves
/// out tables of results and of extreme values where there is a longer record with a clock.
ExportParts parts_of(const ExportTables& tables, const ColumnChoice& choice, const std::string& file);

}  // namespace nacre::measurement
