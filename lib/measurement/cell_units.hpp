#pragma once
// Numbers that carry their unit in the cell, `12.5 N`.

#include <optional>
#include <string_view>

#include "measurement/tester_blocks.hpp"

namespace nacre::measurement {

struct NumberWithUnit {
  std::string_view number, unit;  ///< of one cell
};

/// Takes `12.5 N`, `0,31 mm` or `3.1E-2kN` apart; nothing where the cell is no number with a known unit behind it.
std::optional<NumberWithUnit> number_with_unit(std::string_view cell);

/// Gives columns whose cells all carry one unit that unit, and their cells the numbers alone. A column whose cells
/// differ, or whose heading has another unit, is left as it is.
void take_units_out(TableBlock& block);

/// Why such a column cannot be read, with the remedy; empty where its cells carry no units.
std::string fault_of_units(const TableBlock& block, std::size_t column);

}  // namespace nacre::measurement
