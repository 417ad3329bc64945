#pragma once
// A CSV file that grows by whole lines, each under a key of its own: what a program finished before it was stopped is
// there when it goes on.

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace nacre::study {

/// CSV file of a key and further cells, in any order of lines.
class TextTable {
 public:
  struct Row {
    int line = 0;                    ///< where it stands in the file; 0: added since
    std::vector<std::string> cells;  ///< without the key
  };

  /// Reads what the file holds; an incomplete last line is cut off. `columns` begins with the key's. Throws InputError
  /// when another header stands there or a line is faulty.
  TextTable(std::string path, std::vector<std::string> columns);
  const std::string& path() const { return path_; }
  /// What was read, by key.
  const std::map<std::string, Row>& rows() const { return rows_; }
  /// The cells of `key`, or nothing.
  std::optional<std::vector<std::string>> find(const std::string& key) const;
  /// Appends a line and flushes it. Thread-safe.
  void add(const std::string& key, const std::vector<std::string>& cells);

 private:
  void append(const std::vector<std::string>& cells) const;
  std::string path_;
  std::vector<std::string> columns_;
  mutable std::mutex mutex_;
  std::map<std::string, Row> rows_;
};

}  // namespace nacre::study
