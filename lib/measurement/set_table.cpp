#include "measurement/set_table.hpp"

#include <algorithm>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_files.hpp"

namespace nacre::measurement {
namespace {

std::vector<std::string> texts_of(const CsvRow& row) {
  std::vector<std::string> texts;
  for (const CsvCell& cell : row.cells) texts.push_back(cell.text);
  return texts;
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (&cell == cells.data() ? "" : ",") + csv_cell(cell);
  return line + "\n";
}

}  // namespace

SetTable::SetTable() : heading_(kColumns.begin(), kColumns.end()) {}

SetTable::SetTable(const std::filesystem::path& folder) {
  const std::string file = (folder / kTableName).string();
  const std::string text = read_file_up_to(file, kMostTableBytes);
  CsvLimits limits;
  limits.rows = kMostTableRows;
  CsvReader reader(text, file, limits);
  CsvRow row;
  while (reader.next(row)) {
    if (row.blank()) continue;
    if (!row.fault.empty()) {
      throw InputError::format("{}:{}:{}: {}; this row would be lost by writing the set", file, row.fault_line,
                               row.fault_column, row.fault);
    }
    if (heading_.empty()) {
      for (const CsvCell& cell : row.cells) heading_.emplace_back(trimmed(cell.text));
    } else {
      rows_.push_back(texts_of(row));
    }
  }
  if (heading_.empty()) throw InputError::format("{}: is empty, expected a heading and rows", file);
}

bool SetTable::is_of(const std::vector<std::string>& row, std::string_view specimen) const {
  const auto place =
      static_cast<std::size_t>(std::find(heading_.begin(), heading_.end(), kColumns[kSpecimen]) - heading_.begin());
  return place < row.size() && trimmed(row[place]) == specimen;
}

bool SetTable::holds(std::string_view specimen) const {
  return std::any_of(rows_.begin(), rows_.end(), [&](const auto& row) { return is_of(row, specimen); });
}

void SetTable::remove(std::string_view specimen) {
  std::erase_if(rows_, [&](const auto& row) { return is_of(row, specimen); });
}

void SetTable::append(const std::map<std::string, std::string>& cells) {
  for (const auto& [name, text] : cells) column(name);
  std::vector<std::string> row(heading_.size());
  for (const auto& [name, text] : cells) cell(row, name) = text;
  rows_.push_back(std::move(row));
}

void SetTable::review(std::string_view specimen, bool valid, const std::string& note) {
  for (auto& row : rows_) {
    if (!is_of(row, specimen)) continue;
    cell(row, kColumns[kValid]) = valid ? "1" : "0";
    std::string& whole = cell(row, kColumns[kNote]);
    whole = trimmed(whole).empty() ? note : std::string(trimmed(whole)) + "; " + note;
  }
}

void SetTable::write(const std::filesystem::path& folder) const {
  std::string text = line_of(heading_);
  for (const auto& row : rows_) text += line_of(row);
  write_file_atomically(folder / kTableName, text);
}

std::size_t SetTable::column(std::string_view name) {
  const auto found = std::find(heading_.begin(), heading_.end(), name);
  const auto place = static_cast<std::size_t>(found - heading_.begin());
  if (found != heading_.end()) return place;
  for (auto& row : rows_) {
    if (row.size() == heading_.size()) row.emplace_back();  // a row with missing cells stays as faulty as it was
  }
  heading_.emplace_back(name);
  return place;
}

std::string& SetTable::cell(std::vector<std::string>& row, std::string_view name) {
  const std::size_t place = column(name);
  if (row.size() <= place) row.resize(place + 1);
  return row[place];
}

}  // namespace nacre::measurement
