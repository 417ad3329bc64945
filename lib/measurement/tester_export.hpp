#pragma once
// Raw exports of universal testing machines: Instron Bluehill, ZwickRoell testXpert, MTS (793 and TestSuite), Shimadzu
// Trapezium, and plain tables of time, extension and force. They are read by the names of their columns, not by maker,
// in stages: decoded() -> tables_of() -> parts_of() -> a record of each part. Tables of a frequency sweep go another
// way: decoded() -> sweep_tables_of() -> sweep_of() -> a record of each piece.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "measurement/column_choice.hpp"
#include "measurement/import_fault.hpp"
#include "measurement/sweep_table.hpp"
#include "measurement/tester_columns.hpp"
#include "measurement/tester_series.hpp"

namespace nacre::measurement {

/// One test as the machine recorded it; all vectors as long as `line`, or empty (time; extension and force where the
/// sheet names strain and stress).
struct TesterRecord {
  std::string maker;     ///< "Instron Bluehill", "ZwickRoell testXpert", "MTS", "Shimadzu", or "table"
  std::string encoding;  ///< of the file
  char delimiter = ',';
  char decimal_mark = '.';
  std::string part;  ///< as the file names it; else its number
  std::vector<double> time_s;
  std::vector<double> extension_mm;
  std::vector<double> force_n;
  std::vector<double> strain;                 ///< where the sheet names its column
  std::vector<double> stress_pa;              ///< where the sheet names its column
  std::vector<int> line;                      ///< of the file
  std::map<std::string, std::string> header;  ///< `date`, `operator`, `machine`, where the file has them
  std::array<std::optional<TakenColumn>, kQuantities> taken;
  std::vector<std::string> strains;    ///< headings of strains that were not taken
  std::vector<std::string> decisions;  ///< which columns were taken and why, as sentences
  std::vector<std::string> warnings;
  bool is_bare = false;              ///< the file has no heading
  std::optional<Sweep> sweep;        ///< a frequency sweep: the vectors above are empty, but for `line`
  std::optional<ImportFault> fault;  ///< why this part of the file cannot be used

  const std::optional<TakenColumn>& column(Quantity quantity) const {
    return taken[static_cast<std::size_t>(quantity)];
  }
};

/// Whether a file with a sweep's columns is one: the sheet names no columns of a test.
bool may_be_sweep(const ColumnChoice& choice);

/// The tables of extension and force, or why there are none: tables_of(), and a storage modulus without frequency.
tl::expected<ExportTables, ImportFault> curve_tables_of(const std::vector<std::string_view>& lines,
                                                        const std::string& file, const ColumnChoice& choice);

/// Reads all tests of an export. `bytes` as on disk, `file` for messages. Errors name line, column and what was
/// expected; of a file with several parts, the fault of one stays with it.
tl::expected<std::vector<TesterRecord>, ImportFault> read_tester_export(std::string_view bytes, const std::string& file,
                                                                        const ColumnChoice& choice = {});

}  // namespace nacre::measurement
