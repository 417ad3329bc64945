#pragma once
// measurements.csv as cells: to change one thing in a set and leave the rest as it is.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::measurement {

/// The table of a set. Rows, also those that cannot be used, and cells stay as their author wrote them.
class SetTable {
 public:
  /// The columns of docs/FORMATS.md and no row.
  SetTable();
  /// The table of the set in `folder`. Throws InputError when it cannot be read, or when a row is not CSV, which could
  /// not be written back.
  explicit SetTable(const std::filesystem::path& folder);

  std::size_t size() const { return rows_.size(); }  ///< rows, usable or not
  /// Whether a row has this name, usable or not.
  bool holds(std::string_view specimen) const;
  /// Takes every row of this name out.
  void remove(std::string_view specimen);
  /// A row more, its cells by column; columns that the table lacks are added at the right.
  void append(const std::map<std::string, std::string>& cells);
  /// Sets `valid` in every row of this name, and appends the note to the existing one.
  void review(std::string_view specimen, bool valid, const std::string& note);
  /// Writes measurements.csv, and nothing else. Throws InputError when it cannot be written.
  void write(const std::filesystem::path& folder) const;

 private:
  bool is_of(const std::vector<std::string>& row, std::string_view specimen) const;
  std::size_t column(std::string_view name);  ///< index; added when it is absent
  std::string& cell(std::vector<std::string>& row, std::string_view name);

  std::vector<std::string> heading_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace nacre::measurement
