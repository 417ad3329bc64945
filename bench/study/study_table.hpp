#pragma once
// The table of a study that may be stopped at any moment and goes on where it was: every finished simulation is one line,
// appended as it comes.

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace nacre::study {

/// CSV file of a key (text without comma, quote or line break) and numbers, in any order of lines.
class StudyTable {
 public:
  /// Reads what the file holds; an incomplete last line is cut off. Throws InputError when another header stands there
  /// or a line is faulty.
  StudyTable(std::string path, std::vector<std::string> value_names);
  /// The values of `key`, or nothing.
  std::optional<std::vector<double>> find(const std::string& key) const;
  /// Appends a line and flushes it. Thread-safe.
  void add(const std::string& key, const std::vector<double>& values);

 private:
  std::string header() const;
  void append(const std::string& text) const;
  std::string path_;
  std::vector<std::string> value_names_;
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<double>> rows_;
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
