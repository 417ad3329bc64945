#pragma once
// Raw exports of universal testing machines: Instron Bluehill, ZwickRoell testXpert, MTS (793 and TestSuite), and plain
// tables of time, extension and force. They are read by the names of their columns, not by maker.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "measurement/tester_columns.hpp"

namespace nacre::measurement {

/// Why a file, or one specimen, is unusable, and where.
struct ImportFault {
  std::string file;
  int line = 0;        ///< 0: the file as a whole
  std::string column;  ///< heading or column of the sheet; may be empty
  std::string reason;  ///< a sentence with what was expected
  bool operator==(const ImportFault&) const = default;
};

/// `file:line: column: reason`.
std::string to_string(const ImportFault& fault);

/// One test as the machine recorded it; all vectors as long as `line`, or empty (time only).
struct TesterRecord {
  std::string maker;  ///< "Instron Bluehill", "ZwickRoell testXpert", "MTS", or "table"
  std::vector<double> time_s;
  std::vector<double> extension_mm;
  std::vector<double> force_n;
  std::vector<int> line;                      ///< of the file
  std::map<std::string, std::string> header;  ///< `date`, `operator`, `machine`, where the file has them
  std::string extension_column;               ///< heading of the one taken; empty where there is no heading
  Gauge gauge = Gauge::unknown;               ///< of that column
  std::vector<std::string> other_extensions;  ///< headings of those that were not taken
  std::vector<std::string> warnings;
};

/// Which columns to take, by words of their headings, where a file has several of a kind; empty: the usual ones.
struct ColumnChoice {
  std::string extension;
  std::string force;
};

/// Reads all tests of an export: each heading row begins one, but the blocks of an MTS 793 file are parts of the same
/// test. `bytes` as on disk, `file` for messages. Errors name line, column and what was expected.
tl::expected<std::vector<TesterRecord>, ImportFault> read_tester_export(std::string_view bytes, const std::string& file,
                                                                        const ColumnChoice& choice = {});

}  // namespace nacre::measurement
