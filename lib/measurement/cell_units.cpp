#include "measurement/cell_units.hpp"

#include <fmt/format.h>

#include "base/csv.hpp"
#include "measurement/tester_numbers.hpp"

namespace nacre::measurement {
namespace {

/// Where the unit begins: at the first letter that is no exponent, or at a per cent sign.
std::size_t begin_of_unit(std::string_view cell) {
  for (std::size_t i = 1; i < cell.size(); ++i) {
    const char letter = cell[i];
    const auto byte = static_cast<unsigned char>(letter);
    const bool is_exponent = (letter == 'e' || letter == 'E') && (is_digit(cell[i - 1]) || cell[i - 1] == '.') &&
                             i + 1 < cell.size() && (is_digit(cell[i + 1]) || cell[i + 1] == '-' || cell[i + 1] == '+');
    const bool is_letter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
    const bool is_micro = cell.substr(i).starts_with("\xC2\xB5") || cell.substr(i).starts_with("\xCE\xBC");
    const bool is_east_asian = byte >= 0xE3 && byte < 0xEF;
    if ((is_letter && !is_exponent) || letter == '%' || is_micro || is_east_asian) return i;
  }
  return std::string_view::npos;
}

/// The unit that all filled cells of a column carry; nothing where they do not.
std::optional<std::string_view> unit_of_cells(const TableBlock& block, std::size_t column) {
  std::optional<std::string_view> unit;
  for (std::size_t row = 0; row < block.rows(); ++row) {
    const std::string_view cell = block.cell(row, column);
    if (cell.empty()) continue;
    const auto apart = number_with_unit(cell);
    if (!apart || apart->unit != unit.value_or(apart->unit)) return std::nullopt;
    unit = apart->unit;
  }
  return unit;
}

/// Whether the heading's unit is another one than that of the cells.
bool contradicts(const ColumnName& name, std::string_view unit) {
  if (name.unit.empty()) return false;
  if (!name.quantity) return bare_unit(name.unit) != bare_unit(unit);
  return unit_factor(*name.quantity, name.unit) != unit_factor(*name.quantity, unit);
}

}  // namespace

std::optional<NumberWithUnit> number_with_unit(std::string_view cell) {
  constexpr std::size_t kLongest = 80;  // bytes
  if (cell.size() < 2 || cell.size() > kLongest) return std::nullopt;
  const std::size_t begin = begin_of_unit(cell);
  if (begin == std::string_view::npos) return std::nullopt;
  const NumberWithUnit apart{trimmed(cell.substr(0, begin)), trimmed(cell.substr(begin))};
  if (!looks_like_number(apart.number) || !is_unit(bare_unit(apart.unit))) return std::nullopt;
  return apart;
}

void take_units_out(TableBlock& block) {
  for (std::size_t column = 0; column < block.columns.size(); ++column) {
    ColumnName& name = block.columns[column];
    const auto unit = unit_of_cells(block, column);
    if (!unit || contradicts(name, *unit)) continue;
    if (name.unit.empty()) {
      name = recognise_column(name.heading, *unit);
      name.unit_of_cells = true;
    }
    for (std::size_t row = 0; row < block.rows(); ++row) {
      if (column >= block.cells_in(row)) continue;
      std::string_view& cell = block.cells[block.begins[row] + column];
      if (const auto apart = number_with_unit(cell)) cell = apart->number;
    }
  }
}

std::string fault_of_units(const TableBlock& block, std::size_t column) {
  const ColumnName& name = block.columns[column];
  std::string_view first;
  for (std::size_t row = 0; row < block.rows(); ++row) {
    const auto apart = number_with_unit(block.cell(row, column));
    if (!apart) continue;
    if (contradicts(name, apart->unit)) {
      return fmt::format("the heading is in `{}` and line {} in `{}`, expected one unit; correct the heading",
                         unit_as_written(name.unit), block.lines[row] + 1, apart->unit);
    }
    if (first.empty()) first = apart->unit;
    if (first == apart->unit && (row == 0 || number_with_unit(block.cell(row - 1, column)))) continue;
    return fmt::format(
        "the cells of the column differ in their unit (line {}: `{}`), expected the same in all of them; convert them, "
        "or export the numbers without units",
        block.lines[row] + 1, block.cell(row, column));
  }
  return "";
}

}  // namespace nacre::measurement
