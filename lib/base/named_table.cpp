#include "base/named_table.hpp"

#include <utility>

#include <fmt/ranges.h>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre {

NamedTable::NamedTable(const std::filesystem::path& path, const std::vector<std::string>& required)
    : NamedTable(path.string(), read_file(path), required) {}

NamedTable::NamedTable(std::string source, std::string_view text, const std::vector<std::string>& required)
    : source_(std::move(source)) {
  CsvReader reader(text, source_);
  for (CsvRow row; reader.next(row);) {
    if (!row.fault.empty()) {
      throw InputError::format("{}:{}:{}: {}", source_, row.fault_line, row.fault_column, row.fault);
    }
    if (row.blank()) continue;
    if (columns_.empty()) {
      read_header(row, required);
    } else {
      rows_.push_back(std::move(row));
    }
  }
  if (rows_.empty()) {
    throw InputError::format("{}: no rows; expected a header with {} and at least one row", source_,
                             fmt::join(required, ", "));
  }
}

const std::string& NamedTable::text(std::size_t row, const std::string& column) const {
  const std::size_t index = columns_.at(column);
  if (index >= rows_[row].cells.size()) fail_at(row, column, "the cell is missing");
  return rows_[row].cells[index].text;
}

double NamedTable::positive(std::size_t row, const std::string& column) const {
  const auto value = number_from_text(text(row, column));
  if (!value || *value <= 0.0) fail_at(row, column, "expected a positive number, found '" + text(row, column) + "'");
  return *value;
}

std::optional<double> NamedTable::positive_or_empty(std::size_t row, const std::string& column) const {
  if (trimmed(text(row, column)).empty()) return std::nullopt;
  return positive(row, column);
}

void NamedTable::fail_at(std::size_t row, const std::string& column, const std::string& what) const {
  throw InputError::format("{}:{}: column {}: {}", source_, rows_[row].line, column, what);
}

void NamedTable::read_header(const CsvRow& header, const std::vector<std::string>& required) {
  for (std::size_t index = 0; index < header.cells.size(); ++index) columns_.emplace(header.cells[index].text, index);
  for (const std::string& name : required) {
    if (!columns_.contains(name)) {
      throw InputError::format("{}:{}: column {} is missing; expected {}{}", source_, header.line, name,
                               fmt::join(required, ", "), other_separator(header));
    }
  }
}

}  // namespace nacre
