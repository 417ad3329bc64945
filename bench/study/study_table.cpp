#include "study/study_table.hpp"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"

namespace nacre::study {

StudyTable::StudyTable(std::string path, std::vector<std::string> value_names)
    : path_(std::move(path)), value_names_(std::move(value_names)) {
  if (!std::filesystem::exists(path_)) {
    append(header());
    return;
  }
  std::string text = read_file(path_);
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (whole < text.size()) {
    text.resize(whole);
    write_file_atomically(path_, text);
  }
  if (!text.starts_with(header())) throw InputError::format("{}:1: expected the header {}", path_, trimmed(header()));
  CsvReader reader(text, path_);
  CsvRow row;
  reader.next(row);
  while (reader.next(row)) {
    if (!row.fault.empty() || row.cells.size() != value_names_.size() + 1)
      throw InputError::format("{}:{}: expected {} cells", path_, row.line, value_names_.size() + 1);
    std::vector<double>& values = rows_[row.cells[0].text];
    for (std::size_t i = 1; i < row.cells.size(); ++i) {
      const Result<double> number = number_from_text(row.cells[i].text);
      if (!number) throw InputError::format("{}:{}: {}", path_, row.line, number.error().message);
      values.push_back(*number);
    }
  }
}

std::string StudyTable::header() const {
  std::string text = "key";
  for (const std::string& name : value_names_) text += "," + name;
  return text + "\n";
}

void StudyTable::append(const std::string& text) const {
  std::ofstream file(path_, std::ios::app);
  file << text << std::flush;
  if (!file) throw InputError::format("{}: cannot be written", path_);
}

std::optional<std::vector<double>> StudyTable::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = rows_.find(key);
  return found == rows_.end() ? std::nullopt : std::optional(found->second);
}

void StudyTable::add(const std::string& key, const std::vector<double>& values) {
  std::string line = key;
  for (const double value : values) line += fmt::format(",{:.9g}", value);
  const std::lock_guard lock(mutex_);
  rows_[key] = values;
  append(line + "\n");
}

int fill(StudyTable& table, const std::vector<Wanted>& wanted, double seconds, int threads) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::atomic<int> missing = 0;
  parallel_for(
      static_cast<int>(wanted.size()),
      [&](int i) {
        const Wanted& each = wanted[static_cast<std::size_t>(i)];
        if (table.find(each.key)) return;
        if (std::chrono::steady_clock::now() >= end) {
          ++missing;
          return;
        }
        table.add(each.key, each.simulate());
      },
      threads);
  return missing;
}

}  // namespace nacre::study
