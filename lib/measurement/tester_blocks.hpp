#pragma once
// Second stage of reading an export: lines -> tables, each a heading with its units and its rows of numbers.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "measurement/column_choice.hpp"
#include "measurement/import_fault.hpp"
#include "measurement/tester_columns.hpp"

namespace nacre::measurement {

/// Where lines of words or empty lines stand between two rows of numbers.
struct TableBreak {
  std::size_t row = 0;  ///< the first row after it
  std::string title;    ///< the words; empty for empty lines
  bool operator==(const TableBreak&) const = default;
};

/// One heading and the rows below it. Cells are views of the file's text.
struct TableBlock {
  std::size_t heading = 0;      ///< index of its line
  std::size_t unit_line = 0;    ///< index of the line with its units: the heading, or a line of their own
  bool is_bare = false;         ///< numbers without a heading
  bool has_cell_units = false;  ///< numbers carry their unit
  std::string title;            ///< the words before the heading
  std::vector<ColumnName> columns;
  std::vector<std::string> labels;  ///< of a line above the names, by column; empty when there is none
  std::vector<std::size_t> lines;   ///< index of each row's line
  std::vector<std::size_t> begins;  ///< of each row in `cells`, and the end
  std::vector<std::string_view> cells;
  std::vector<TableBreak> breaks;
  std::size_t statistics = 0;    ///< rows of means and deviations, which are left out
  std::size_t ignored_rows = 0;  ///< rows of numbers below an unknown heading, which are left out

  std::size_t rows() const { return lines.size(); }
  std::size_t cells_in(std::size_t row) const { return begins[row + 1] - begins[row]; }
  /// Empty beyond the row's last cell.
  std::string_view cell(std::size_t row, std::size_t column) const {
    return column < cells_in(row) ? cells[begins[row] + column] : std::string_view{};
  }
};

struct ExportTables {
  char delimiter = ',';
  std::vector<TableBlock> blocks;
};

/// Finds the tables of extension and force. `lines` are the file's; `file` is for messages. The fault names the line
/// that resembles a heading most, or a damaged row.
tl::expected<ExportTables, ImportFault> tables_of(const std::vector<std::string_view>& lines, const std::string& file,
                                                  const ColumnChoice& choice);

}  // namespace nacre::measurement
