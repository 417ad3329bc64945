#include "measurement/decimal_marks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nacre::measurement {
namespace {

std::vector<std::string_view> cells_of_column(const TableBlock& block, std::size_t column,
                                              std::span<const std::size_t> rows) {
  std::vector<std::string_view> cells;
  cells.reserve(rows.size());
  for (const std::size_t row : rows) cells.push_back(block.cell(row, column));
  return cells;
}

}  // namespace

DecimalMark DecimalMarks::of(std::size_t column) const {
  const auto found = own.find(column);
  return found == own.end() ? usual : found->second.value_or(usual);
}

bool DecimalMarks::contradict(std::size_t column) const {
  return std::find(contradictory.begin(), contradictory.end(), column) != contradictory.end();
}

DecimalMarks decimal_marks(const TableBlock& block, std::span<const std::size_t> columns,
                           std::span<const std::size_t> rows, char delimiter) {
  DecimalMarks marks;
  std::optional<DecimalMark> usual, lone;
  bool one_lone = true;
  for (const std::size_t column : columns) {
    const ColumnMark found = column_mark(cells_of_column(block, column, rows));
    if (found.contradiction > 0) {
      const auto line_at = [&](std::size_t place) { return block.lines[rows[place]] + 1; };
      marks.contradiction = std::min(marks.contradiction, line_at(found.contradiction));
      marks.contradicted = line_at(found.first);
      marks.contradictory.push_back(column);
      continue;
    }
    marks.own[column] = found.mark;
    if (found.mark && !usual) usual = found.mark;
    one_lone = one_lone && (!found.lone || lone.value_or(*found.lone) == *found.lone);
    if (found.lone) lone = found.lone;
  }
  if (!one_lone) lone.reset();
  marks.usual = usual.value_or(lone.value_or(delimiter == ',' ? DecimalMark::point : DecimalMark::comma));
  marks.is_assumed = !usual && lone && delimiter != ',';
  return marks;
}

std::string fault_of_marks(const DecimalMarks& marks) {
  return fmt::format(
      "decimal points and decimal commas in one file (line {} has the other mark), expected one of them throughout",
      marks.contradicted);
}

std::string doubt_of_marks(const DecimalMarks& marks, const std::string& file) {
  return fmt::format(
      "{}: every number with a {} has three digits behind it; it is read as the decimal mark, not as one of thousands",
      file, marks.usual == DecimalMark::comma ? "comma" : "point");
}

}  // namespace nacre::measurement
