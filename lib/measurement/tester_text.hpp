#pragma once
// Text of instruments in one encoding, cut into lines and cells.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::measurement {

/// Lines without their ends (LF, CRLF or CR).
std::vector<std::string_view> lines_of(std::string_view text);

/// The lines of an export: a heading of which a quoted cell holds line breaks is one line, the rest of it empty ones.
std::vector<std::string_view> export_lines(std::string_view text);

/// The delimiter of columns of fixed width: two blanks and more, whose cells are not quoted.
inline constexpr char kGaps = ' ';
/// The delimiter of columns between single blanks: a unit in brackets belongs to the name before it.
inline constexpr char kBlanks = '\v';
/// `comma`, `semicolon`, `tab`, `bar`, `blanks`.
std::string_view delimiter_in_words(char delimiter);

/// Cells of one line, blanks around them removed; a cell in double quotes may hold the delimiter. More lenient than
/// RFC 4180: header blocks of testing machines hold any text.
std::vector<std::string> cells_of(std::string_view line, char delimiter);

/// The same without copies, into `cells`, for long tables: a doubled quote inside a quoted cell stays doubled.
void split_cells(std::string_view line, char delimiter, std::vector<std::string_view>& cells);

/// One row of a table and the line on which it begins, from 1.
struct TextRow {
  int line = 0;
  std::string_view text;  ///< without the line end
  bool is_torn = false;   ///< a cell's opening quote has no closing one; the row ends with its first line
};

/// The rows of a table for cells_of(): a cell in double quotes may hold line breaks. A quote without an end takes no
/// other row with it.
std::vector<TextRow> rows_of(std::string_view text, char delimiter);

/// ASCII lower case with the letters of western European languages spelt out (ue for u umlaut, e for e acute),
/// full-width letters and brackets made plain, and blanks in one place made one: for comparing names.
std::string plain_words(std::string_view text);

}  // namespace nacre::measurement
