#pragma once
// Fifth and sixth stages of reading an export: the columns of a specimen -> one series of numbers for each quantity,
// and the reasons for which columns were taken.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "measurement/column_choice.hpp"
#include "measurement/import_fault.hpp"
#include "measurement/tester_blocks.hpp"

namespace nacre::measurement {

/// The column that was taken for a quantity, and what else there was.
struct TakenColumn {
  std::string heading = {};
  std::string unit = {};  ///< as written; empty where none was read
  bool unit_of_sheet = false;
  double factor = 1.0;  ///< to the base unit
  Gauge gauge = Gauge::unknown;
  std::vector<std::string> not_taken = {};  ///< headings of the same quantity
};

/// The rows of one specimen in one table.
struct ColumnSeries {
  std::array<std::optional<TakenColumn>, kQuantities> taken = {};
  std::array<std::vector<double>, kQuantities> values = {};  ///< in base units; empty where nothing was taken
  std::vector<int> line = {};                                ///< of the file, from 1
  std::vector<std::string> strains = {};    ///< headings of strains that were not taken: an extensometer was there
  std::vector<std::string> decisions = {};  ///< which column was taken, and why
  std::vector<std::string> warnings = {};
  char decimal_mark = '.';

  const std::vector<double>& of(Quantity quantity) const { return values[static_cast<std::size_t>(quantity)]; }
  std::vector<double>& of(Quantity quantity) { return values[static_cast<std::size_t>(quantity)]; }
  const std::optional<TakenColumn>& column(Quantity quantity) const {
    return taken[static_cast<std::size_t>(quantity)];
  }
};

/// The values of a column as numbers or times of day, without a unit's factor; nothing where a cell is neither.
std::optional<std::vector<double>> numbers_of(const TableBlock& block, std::size_t column,
                                              const std::vector<std::size_t>& rows, char delimiter);

/// Chooses among `columns` of a block and reads `rows` of them. A column that the sheet names wins, by its exact name
/// before words of it. Otherwise set points and columns across the specimen are never taken, calibrated columns come
/// before raw ones, those with a unit before those without, those that move before dead ones, then the usual names,
/// then the first. The clock is the first of the best name that never goes back. The fault is that of a needed column.
tl::expected<ColumnSeries, ImportFault> series_of(const TableBlock& block, const std::vector<std::size_t>& columns,
                                                  const std::vector<std::size_t>& rows, char delimiter,
                                                  const ColumnChoice& choice, const std::string& file);

}  // namespace nacre::measurement
