#include "study/study_table.hpp"

#include <atomic>
#include <chrono>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"

namespace nacre::study {

namespace {

std::vector<std::string> columns_of(std::vector<std::string> value_names) {
  value_names.insert(value_names.begin(), "key");
  return value_names;
}

/// Throws InputError with the first cell that is no number.
std::vector<double> numbers_of(const std::vector<std::string>& cells) {
  std::vector<double> values;
  for (const std::string& cell : cells) {
    const Result<double> number = number_from_text(cell);
    if (!number) throw InputError(number.error().message);
    values.push_back(*number);
  }
  return values;
}

}  // namespace

StudyTable::StudyTable(std::string path, std::vector<std::string> value_names)
    : text_(std::move(path), columns_of(std::move(value_names))) {
  for (const auto& [key, row] : text_.rows()) {
    try {
      numbers_of(row.cells);
    } catch (const InputError& error) {
      throw InputError::format("{}:{}: {}", text_.path(), row.line, error.what());
    }
  }
}

std::optional<std::vector<double>> StudyTable::find(const std::string& key) const {
  const auto cells = text_.find(key);
  return cells ? std::optional(numbers_of(*cells)) : std::nullopt;
}

void StudyTable::add(const std::string& key, const std::vector<double>& values) {
  std::vector<std::string> cells;
  for (const double value : values) cells.push_back(fmt::format("{:.9g}", value));
  text_.add(key, cells);
}

int fill(StudyTable& table, const std::vector<Wanted>& wanted, double seconds, int threads) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::atomic<int> missing = 0;
  parallel_for(
      static_cast<int>(wanted.size()),
      [&](int i) {
        const Wanted& each = wanted[i];
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
