#pragma once
// What an export holds, for a person who writes the sheet: maker, parts, columns, units, ranges, sparklines.

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "measurement/column_choice.hpp"
#include "measurement/import_fault.hpp"

namespace nacre::measurement {

struct ListedColumn {
  std::string heading, unit;  ///< unit: empty where none is read
  std::string quantity;       ///< `time`, `extension`, `force`, `strain`, `stress`, or of a sweep; empty for others
  bool taken = false;         ///< without a choice in the sheet
  double least = 0.0, most = 0.0;
  std::string sparkline;  ///< empty where the cells are no numbers
};

struct ListedPart {
  std::string name;
  int line = 0;  ///< of the heading
  std::size_t rows = 0;
  std::vector<ListedColumn> columns;
  std::vector<std::string> decisions;
  std::string fault;  ///< why it cannot be read as it stands; may be empty
};

struct ListedExport {
  std::string maker, encoding, delimiter;
  std::vector<ListedPart> parts;
  std::vector<std::string> notes;  ///< tables that are left out
};

/// Of a file that holds no table the fault.
tl::expected<ListedExport, ImportFault> list_export(std::string_view bytes, const std::string& file,
                                                    const ColumnChoice& choice = {});

}  // namespace nacre::measurement
