#pragma once
// Tables of results.

#include <filesystem>
#include <string>
#include <vector>

namespace nacre::calibration_study {

/// A CSV file of results whose first columns are the key of a row. Rows are added one by one; what has a row is not
/// computed again.
class CalibrationTable {
 public:
  CalibrationTable(std::filesystem::path file, std::vector<std::string> columns, std::size_t key_columns);
  bool has(const std::vector<std::string>& key) const;
  void add(const std::vector<std::string>& cells);

 private:
  std::filesystem::path file_;
  std::size_t key_columns_;
  std::vector<std::string> keys_;
};

}  // namespace nacre::calibration_study
