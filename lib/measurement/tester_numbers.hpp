#pragma once
// Numbers as instruments and spreadsheets write them.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace nacre::measurement {

/// Which mark separates the decimals of a column.
enum class DecimalMark { point, comma };

/// Reads a number as an instrument writes it; the other mark, a blank (no-break, narrow or thin, too) or an apostrophe
/// may group thousands; a true minus sign counts as one. A number with an exponent is never grouped by a mark unless it
/// has both marks.
std::optional<double> instrument_number(std::string_view text, DecimalMark mark);

/// The decimal mark that a single cell implies: `1,5` comma, `1.5` point, `1,234` or `12` none.
std::optional<DecimalMark> decimal_evidence(std::string_view text);

/// 0 to 9.
constexpr bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// Whether the cell looks like a number under either mark.
bool looks_like_number(std::string_view text);

/// What the cells of one column say together about its decimal mark.
struct ColumnMark {
  std::optional<DecimalMark> mark;  ///< nothing: no cell decides
  std::optional<DecimalMark> lone;  ///< where no cell decides: the one mark in its cells, as a decimal mark
  std::size_t contradiction = 0;    ///< place of the first cell with the other mark; 0: none
  std::size_t first = 0;            ///< place of the cell that it contradicts
};

/// One decimal mark for the whole column. Where no single cell decides, a column whose numbers below a thousand have no
/// mark and whose larger ones are all grouped by threes has grouped thousands.
ColumnMark column_mark(std::span<const std::string_view> cells);

/// Seconds of a time of day or a duration, `10:00:00.540`, `02:03,5`, `2026-03-12T10:00:00`; nothing when it is not
/// one.
std::optional<double> clock_seconds(std::string_view text);

}  // namespace nacre::measurement
