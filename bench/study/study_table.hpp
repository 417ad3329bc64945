#pragma once
// The table of a study that may be stopped at any moment and goes on where it was: every finished simulation is one
// line, appended as it comes.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/text_table.hpp"

namespace nacre::study {

/// A table of a key and numbers.
class StudyTable {
 public:
  /// Reads what the file holds, as TextTable does; throws InputError also where a number is none.
  StudyTable(std::string path, std::vector<std::string> value_names);
  /// The values of `key`, or nothing.
  std::optional<std::vector<double>> find(const std::string& key) const;
  /// Appends a line and flushes it. Thread-safe.
  void add(const std::string& key, const std::vector<double>& values);

 private:
  TextTable text_;
};

/// One line that a study wants.
struct Wanted {
  std::string key;
  std::function<std::vector<double>()> simulate;
};

/// Simulates what the table lacks, in the order given, on `threads` threads (0: all allowed cores); begins nothing new
/// after `seconds`. Returns how many are still missing.
int fill(StudyTable& table, const std::vector<Wanted>& wanted, double seconds, int threads);

}  // namespace nacre::study
