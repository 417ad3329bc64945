#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::game {

/// A table whose cells are asked for by row and column name. Throws InputError naming file, line, column.
class NamedTable {
 public:
  NamedTable(std::filesystem::path path, const std::vector<std::string>& required) : path_(std::move(path)) {
    const std::string text = read_file(path_);
    CsvReader reader(text, path_.string());
    for (CsvRow row; reader.next(row);) {
      if (!row.fault.empty()) {
        throw InputError::format("{}:{}:{}: {}", path_.string(), row.fault_line, row.fault_column, row.fault);
      }
      if (row.blank()) continue;
      if (columns_.empty()) {
        read_header(row, required);
      } else {
        rows_.push_back(std::move(row));
      }
    }
    if (rows_.empty()) {
      throw InputError::format("{}: no rows; expected a header with {} and at least one row", path_.string(),
                               fmt::join(required, ", "));
    }
  }

  std::size_t size() const { return rows_.size(); }
  bool has(const std::string& column) const { return columns_.contains(column); }

  const std::string& text(std::size_t row, const std::string& column) const {
    const std::size_t index = columns_.at(column);
    if (index >= rows_[row].cells.size()) fail_at(row, column, "the cell is missing");
    return rows_[row].cells[index].text;
  }

  double positive(std::size_t row, const std::string& column) const {
    const auto value = number_from_text(text(row, column));
    if (!value || *value <= 0.0) fail_at(row, column, "expected a positive number, found '" + text(row, column) + "'");
    return *value;
  }

  /// Nothing for an empty cell.
  std::optional<double> positive_or_empty(std::size_t row, const std::string& column) const {
    if (trimmed(text(row, column)).empty()) return std::nullopt;
    return positive(row, column);
  }

  [[noreturn]] void fail_at(std::size_t row, const std::string& column, const std::string& what) const {
    throw InputError::format("{}:{}: column {}: {}", path_.string(), rows_[row].line, column, what);
  }

 private:
  void read_header(const CsvRow& header, const std::vector<std::string>& required) {
    for (std::size_t index = 0; index < header.cells.size(); ++index) columns_.emplace(header.cells[index].text, index);
    for (const std::string& name : required) {
      if (!columns_.contains(name)) {
        throw InputError::format("{}:{}: column {} is missing; expected {}", path_.string(), header.line, name,
                                 fmt::join(required, ", "));
      }
    }
  }

  std::filesystem::path path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<CsvRow> rows_;
};

}  // namespace nacre::game
