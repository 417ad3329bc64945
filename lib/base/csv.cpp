#include "base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nacre {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 40;
  return text.size() <= kMost ? std::string(text) : std::string(text.substr(0, kMost)) + "...";
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  std::uint32_t code = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code >= kSmallest[length] && code <= 0x10FFFF && !surrogate ? length : 0;
}

bool CsvRow::blank() const {
  return fault.empty() &&
         std::all_of(cells.begin(), cells.end(), [](const CsvCell& cell) { return trimmed(cell.text).empty(); });
}

CsvReader::CsvReader(std::string_view text, std::string source, const CsvLimits& limits)
    : text_(text), source_(std::move(source)), limits_(limits) {
  if (text_.substr(0, 3) == kByteOrderMark) position_ = 3;
}

bool CsvReader::at_line_break() const {
  if (at_end()) return false;
  return text_[position_] == '\n' || (text_[position_] == '\r' && text_.substr(position_, 2) == "\r\n");
}

void CsvReader::skip_line_break() {
  position_ += text_[position_] == '\r' ? 2 : 1;
  ++line_;
  column_ = 1;
}

void CsvReader::resume_after_line_of(std::size_t position, int line) {
  const std::size_t line_break = text_.find('\n', position);
  position_ = line_break == std::string_view::npos ? text_.size() : line_break + 1;
  line_ = line + 1;
  column_ = 1;
}

bool CsvReader::fault(CsvRow& row, std::string reason) {
  row.fault = std::move(reason);
  row.fault_line = line_;
  row.fault_column = column_;
  return false;
}

bool CsvReader::next(CsvRow& row) {
  row.cells.clear();
  row.fault.clear();
  if (at_end()) return false;
  if (++rows_ > limits_.rows) {
    throw InputError::format("{}:{}: more than {} rows, expected at most that many", source_, line_, limits_.rows);
  }
  row.line = line_;
  while (true) {
    // A row that goes wrong is given up at the line on which its faulty cell began: an opening quote without an end
    // must not swallow the rest of the table.
    const std::size_t cell_start = position_;
    const int cell_line = line_;
    CsvCell& cell = row.cells.emplace_back();
    bool good = read_cell(row, cell);
    if (good && row.cells.size() > limits_.cells_per_row) {
      good = fault(row, fmt::format("expected at most {} cells in a row", limits_.cells_per_row));
    }
    if (!good) {
      resume_after_line_of(cell_start, cell_line);
      return true;
    }
    if (at_end()) return true;
    if (at_line_break()) {
      skip_line_break();
      return true;
    }
    ++position_;  // the comma
    ++column_;
  }
}

bool CsvReader::read_cell(CsvRow& row, CsvCell& cell) {
  cell.line = line_;
  cell.column = column_;
  return !at_end() && text_[position_] == '"' ? read_quoted(row, cell) : read_plain(row, cell);
}

bool CsvReader::read_quoted(CsvRow& row, CsvCell& cell) {
  ++position_;
  ++column_;
  while (true) {
    if (at_end()) {
      fault(row, "the quote that opens this cell is never closed, expected a closing double quote");
      row.fault_line = cell.line;
      row.fault_column = cell.column;
      return false;
    }
    if (text_[position_] == '"') {
      ++position_;
      ++column_;
      if (at_end() || text_[position_] == ',' || at_line_break()) return true;
      if (text_[position_] != '"')
        return fault(row, "expected a comma or the end of the line after a closing double quote");
    }
    if (!keep_character(row, cell)) return false;
  }
}

bool CsvReader::read_plain(CsvRow& row, CsvCell& cell) {
  while (!at_end() && text_[position_] != ',' && !at_line_break()) {
    if (text_[position_] == '"')
      return fault(row, "a double quote inside a cell, expected the whole cell in double quotes");
    if (!keep_character(row, cell)) return false;
  }
  return true;
}

bool CsvReader::keep_character(CsvRow& row, CsvCell& cell) {
  const std::size_t length = utf8_length(text_.substr(position_, 4));
  if (length == 0 || text_[position_] == '\0') return fault(row, "not UTF-8 text, expected a table saved as UTF-8");
  if (cell.text.size() + length > limits_.bytes_per_cell) {
    return fault(row, fmt::format("expected at most {} bytes in a cell", limits_.bytes_per_cell));
  }
  cell.text.append(text_, position_, length);
  if (text_[position_] == '\n') {
    ++line_;
    column_ = 0;
  }
  position_ += length;
  ++column_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string other_separator(std::string_view heading) {
  if (heading.find(',') != std::string_view::npos) return "";
  for (const auto& [separator, name] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")}) {
    if (heading.find(separator) != std::string_view::npos)
      return std::string("; it is separated by ") + name + ", expected commas, and decimal points";
  }
  return "";
}

std::string other_separator(const CsvRow& heading) {
  return heading.cells.size() == 1 ? other_separator(heading.cells.front().text) : "";
}

Result<double> number_from_text(std::string_view text) {
  std::string_view digits = trimmed(text);
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    return fail("`{}` is not a number, expected a finite number with a decimal point", shown(text));
  }
  return value;
}

Result<int> integer_from_text(std::string_view text) {
  const Result<double> number = number_from_text(text);
  const double limit = std::numeric_limits<std::int32_t>::max();
  if (!number || std::floor(*number) != *number || std::abs(*number) > limit) {
    return fail("`{}` is not a whole number, expected one of at most 2147483647 in magnitude", shown(text));
  }
  return static_cast<int>(*number);
}

std::string csv_cell(std::string_view text) {
  const bool edge_blank = text != trimmed(text);
  if (!edge_blank && text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

}  // namespace nacre
