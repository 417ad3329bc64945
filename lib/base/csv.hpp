#pragma once
// Reading tables that a person or an instrument wrote (RFC 4180): every cell knows its line and column, and one bad row
// does not lose the others.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace nacre {

/// One cell and the place of its first character, both counted from 1; `column` counts characters, not bytes.
struct CsvCell {
  std::string text;
  int line = 0;
  int column = 0;
};

/// One row. When the row is malformed (quotes, encoding, a limit), `fault` says what was expected, `fault_line` and
/// `fault_column` where; its cells are then meaningless.
struct CsvRow {
  int line = 0;
  std::vector<CsvCell> cells;
  std::string fault;
  int fault_line = 0;
  int fault_column = 0;
  bool blank() const;  ///< nothing but empty cells
};

/// Bounds against hostile files; a row beyond one of the last two is a faulty row.
struct CsvLimits {
  std::size_t rows = 1'000'001;  ///< header included; exceeded: InputError
  std::size_t cells_per_row = 256;
  std::size_t bytes_per_cell = 1 << 16;
};

/// Pulls the rows of a table out of `text`, which must outlive the reader: UTF-8 with or without byte-order mark,
/// comma, LF or CRLF, cells in double quotes may hold commas, line breaks and doubled quotes. A malformed row is handed
/// out with its fault, and reading goes on at the next line. `source` names the table in errors.
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string source, const CsvLimits& limits = {});
  /// Reads the next row into `row` (whose memory is reused); false at the end. Throws InputError when the table has
  /// more rows than allowed.
  bool next(CsvRow& row);

 private:
  bool at_end() const { return position_ >= text_.size(); }
  bool at_line_break() const;
  void skip_line_break();
  void resume_after_line_of(std::size_t position, int line);
  bool read_cell(CsvRow& row, CsvCell& cell);
  bool read_quoted(CsvRow& row, CsvCell& cell);
  bool read_plain(CsvRow& row, CsvCell& cell);
  bool keep_character(CsvRow& row, CsvCell& cell);
  bool fault(CsvRow& row, std::string reason);

  std::string_view text_;
  std::string source_;
  CsvLimits limits_;
  std::size_t position_ = 0;
  int line_ = 1;
  int column_ = 1;
  std::size_t rows_ = 0;
};

/// The end of an error about a heading whose columns are separated by something other than commas; empty for commas.
std::string other_separator(std::string_view heading);
std::string other_separator(const CsvRow& heading);

/// A finite number with a decimal point, surrounding blanks allowed, whatever the locale. The error says what was
/// expected.
Result<double> number_from_text(std::string_view text);

/// A whole number in the range of int32, surrounding blanks allowed.
Result<int> integer_from_text(std::string_view text);

/// Bytes of the UTF-8 character at the head of `text`, which is not empty: 1 to 4, or 0 when it is not valid UTF-8
/// (overlong forms, surrogates and code points beyond U+10FFFF included).
std::size_t utf8_length(std::string_view text);

/// `text` without leading and trailing blanks and tabs.
std::string_view trimmed(std::string_view text);

/// `text` as a cell: in quotes when it needs them.
std::string csv_cell(std::string_view text);

}  // namespace nacre
