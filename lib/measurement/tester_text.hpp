#pragma once
// Text of instruments in one encoding, cut into lines and cells.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace nacre::measurement {

/// Bytes of a text file as UTF-8 without byte-order mark: UTF-8, UTF-16 of either byte order (marked, or recognised by
/// its zero bytes), otherwise Windows-1252, which makers' programs write in western Europe. Error: the file is not text
/// (a workbook, a picture, a cut UTF-16 character), with what was expected.
Result<std::string> utf8_from_instrument(std::string_view bytes);

/// Lines without their ends (LF, CRLF or CR).
std::vector<std::string_view> lines_of(std::string_view text);

/// Cells of one line, blanks around them removed; a cell in double quotes may hold the delimiter. More lenient than
/// RFC 4180: header blocks of testing machines hold any text.
std::vector<std::string> cells_of(std::string_view line, char delimiter);

/// One row of a table and the line on which it begins, from 1.
struct TextRow {
  int line = 0;
  std::string_view text;  ///< without the line end
  bool is_torn = false;   ///< a cell's opening quote has no closing one; the row ends with its first line
};

/// The rows of a table for cells_of(): a cell in double quotes may hold line breaks. A quote without an end takes no
/// other row with it.
std::vector<TextRow> rows_of(std::string_view text, char delimiter);

/// ASCII lower case with the letters of western European languages spelt out (ue for u umlaut, e for e acute) and
/// blanks in one place made one: for comparing names.
std::string plain_words(std::string_view text);

/// Which mark separates the decimals of a file.
enum class DecimalMark { point, comma };

/// Reads a number as an instrument writes it; the other mark, a blank (a no-break space, too) or an apostrophe
/// may group thousands.
std::optional<double> instrument_number(std::string_view text, DecimalMark mark);

/// The decimal mark that a single cell implies: `1,5` comma, `1.5` point, `1,234` or `12` none.
std::optional<DecimalMark> decimal_evidence(std::string_view text);

/// Whether the cell looks like a number under either mark.
bool looks_like_number(std::string_view text);

}  // namespace nacre::measurement
