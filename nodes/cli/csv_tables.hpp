#pragma once
// Messages as CSV: a table per topic, a row per message, columns by the channel's table of fields.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/file_aside.hpp"
#include "log_messages.hpp"

namespace nacre::cli {

class CsvTables {
 public:
  /// Into `folder`, which exists.
  explicit CsvTables(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// A row of `TOPIC.csv`: log_time_s and publish_time_s (seconds since 1970), then the fields. A member of a struct is
  /// `parameters.modulus`; a list is JSON in one cell; what is absent an empty one. Throws InputError, NoSpace.
  void add(const LogMessage& message);
  /// The files are there now.
  void finish();

 private:
  struct Table {
    std::vector<std::string> columns;  ///< places in the message
    FileAside file;
    std::string waiting;
  };
  Table& table_of(const LogMessage& message);

  std::filesystem::path folder_;
  std::map<std::string, std::unique_ptr<Table>> tables_;
};

}  // namespace nacre::cli
