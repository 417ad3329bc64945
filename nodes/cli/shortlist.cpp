#include "shortlist.hpp"

#include <algorithm>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::cli {
namespace {

constexpr std::size_t kMostBytes = 1u << 20;
constexpr std::string_view kColumn = "design";

/// Place of the column in the heading.
std::size_t column_in(const CsvRow& heading, const std::string& file) {
  const auto found =
      std::ranges::find_if(heading.cells, [](const CsvCell& cell) { return trimmed(cell.text) == kColumn; });
  if (found == heading.cells.end())
    throw InputError::format("{}:1: expected a shortlist, with a column `{}`{}", file, kColumn,
                             other_separator(heading));
  return static_cast<std::size_t>(found - heading.cells.begin());
}

}  // namespace

std::vector<pattern::Design> read_shortlist(const std::filesystem::path& file) {
  const std::string text = read_file_up_to(file, kMostBytes);
  CsvReader reader(text, file.string());
  CsvRow row;
  if (!reader.next(row)) throw InputError::format("{}: is empty, expected a shortlist", file.string());
  const std::size_t column = column_in(row, file.string());
  std::vector<pattern::Design> designs;
  while (reader.next(row)) {
    if (!row.fault.empty()) throw InputError::format("{}:{}: {}", file.string(), row.fault_line, row.fault);
    if (row.blank()) continue;
    const std::string_view cell = column < row.cells.size() ? trimmed(row.cells[column].text) : std::string_view();
    const auto design = pattern::design_from_word(cell);
    if (!design) throw InputError::format("{}:{}: {}: {}", file.string(), row.line, kColumn, design.error().message);
    if (std::ranges::count(designs, *design) == 0) designs.push_back(*design);
  }
  if (designs.empty()) throw InputError::format("{}: holds no design", file.string());
  return designs;
}

}  // namespace nacre::cli
