#include "study/text_table.hpp"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/csv.hpp"
#include "base/files.hpp"

namespace nacre::study {

TextTable::TextTable(std::string path, std::vector<std::string> columns)
    : path_(std::move(path)), columns_(std::move(columns)) {
  if (!std::filesystem::exists(path_)) {
    append(columns_);
    return;
  }
  std::string text = read_file(path_);
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (whole < text.size()) {
    text.resize(whole);
    write_file_atomically(path_, text);
  }
  const std::string header = fmt::format("{}", fmt::join(columns_, ","));
  if (!text.starts_with(header + "\n")) throw InputError::format("{}:1: expected the header {}", path_, header);
  CsvReader reader(text, path_);
  CsvRow row;
  reader.next(row);
  while (reader.next(row)) {
    if (!row.fault.empty() || row.cells.size() != columns_.size())
      throw InputError::format("{}:{}: expected {} cells", path_, row.line, columns_.size());
    Row& kept = rows_[row.cells[0].text];
    kept = {row.line, {}};
    for (std::size_t i = 1; i < row.cells.size(); ++i) kept.cells.push_back(row.cells[i].text);
  }
}

void TextTable::append(const std::vector<std::string>& cells) const {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + csv_cell(cell);
  std::ofstream file(path_, std::ios::app);
  file << line + "\n" << std::flush;
  if (!file) throw InputError::format("{}: cannot be written", path_);
}

std::optional<std::vector<std::string>> TextTable::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = rows_.find(key);
  return found == rows_.end() ? std::nullopt : std::optional(found->second.cells);
}

void TextTable::add(const std::string& key, const std::vector<std::string>& cells) {
  std::vector<std::string> line = {key};
  line.insert(line.end(), cells.begin(), cells.end());
  const std::lock_guard lock(mutex_);
  rows_[key] = {0, cells};
  append(line);
}

}  // namespace nacre::study
