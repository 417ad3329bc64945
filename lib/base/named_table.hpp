#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/csv.hpp"

namespace nacre {

/// A table whose cells are read by row and column name. Throws InputError naming file, line, column.
class NamedTable {
 public:
  NamedTable(const std::filesystem::path& path, const std::vector<std::string>& required);
  /// `source` names the table in errors.
  NamedTable(std::string source, std::string_view text, const std::vector<std::string>& required);

  std::size_t size() const { return rows_.size(); }
  bool has(const std::string& column) const { return columns_.contains(column); }
  const std::string& text(std::size_t row, const std::string& column) const;
  double positive(std::size_t row, const std::string& column) const;
  /// Nothing for an empty cell.
  std::optional<double> positive_or_empty(std::size_t row, const std::string& column) const;
  [[noreturn]] void fail_at(std::size_t row, const std::string& column, const std::string& what) const;

 private:
  void read_header(const CsvRow& header, const std::vector<std::string>& required);

  std::string source_;
  std::map<std::string, std::size_t> columns_;
  std::vector<CsvRow> rows_;
};

}  // namespace nacre
