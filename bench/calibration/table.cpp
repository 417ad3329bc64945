#include "table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <fstream>

#include "base/result.hpp"

namespace nacre::calibration_study {

CalibrationTable::CalibrationTable(std::filesystem::path file, std::vector<std::string> columns,
                                   std::size_t key_columns)
    : file_(std::move(file)), key_columns_(key_columns) {
  const std::string head = fmt::format("{}", fmt::join(columns, ","));
  std::filesystem::create_directories(file_.parent_path());
  if (!std::filesystem::exists(file_)) {
    std::ofstream(file_) << head << '\n';
    return;
  }
  std::ifstream lines(file_);
  std::string line;
  std::getline(lines, line);
  if (line != head) throw InputError::format("{}: line 1: columns of another study, expected {}", file_.string(), head);
  while (std::getline(lines, line)) {
    std::size_t end = 0;
    for (std::size_t k = 0; k < key_columns_ && end != std::string::npos; ++k)
      end = line.find(',', k == 0 ? 0 : end + 1);
    keys_.push_back(line.substr(0, end));
  }
}

bool CalibrationTable::has(const std::vector<std::string>& key) const {
  return std::find(keys_.begin(), keys_.end(), fmt::format("{}", fmt::join(key, ","))) != keys_.end();
}

void CalibrationTable::add(const std::vector<std::string>& cells) {
  assert(cells.size() >= key_columns_);
  std::ofstream(file_, std::ios::app) << fmt::format("{}\n", fmt::join(cells, ","));
  keys_.push_back(
      fmt::format("{}", fmt::join(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(key_columns_), ",")));
}

}  // namespace nacre::calibration_study
