#pragma once
// The decimal mark of each column of a table.

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measurement/tester_blocks.hpp"
#include "measurement/tester_numbers.hpp"

namespace nacre::measurement {

/// A column's own mark, else that of the others, else that of the delimiter.
struct DecimalMarks {
  std::map<std::size_t, std::optional<DecimalMark>> own;  ///< by column; nothing: its cells do not decide
  DecimalMark usual = DecimalMark::point;                 ///< of columns without one of their own
  bool is_assumed = false;                 ///< no cell decides whether the usual mark is one of thousands
  std::vector<std::size_t> contradictory;  ///< columns that hold both marks
  std::size_t contradiction = static_cast<std::size_t>(-1), contradicted = 0;  ///< lines of the two marks, from 1

  DecimalMark of(std::size_t column) const;
  bool contradict(std::size_t column) const;
};

/// Of `columns`, as their cells in `rows` tell.
DecimalMarks decimal_marks(const TableBlock& block, std::span<const std::size_t> columns,
                           std::span<const std::size_t> rows, char delimiter);

/// Why a column that holds both marks cannot be read.
std::string fault_of_marks(const DecimalMarks& marks);

/// Where the usual mark is assumed, a warning about it.
std::string doubt_of_marks(const DecimalMarks& marks, const std::string& file);

}  // namespace nacre::measurement
