#include "growth.hpp"

#include <filesystem>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::search_study {
namespace {

Growth read_growth(const std::string& path) {
  Growth growth;
  const std::string text = read_file(path);
  CsvReader reader(text, path);
  CsvRow row;
  reader.next(row);
  while (reader.next(row)) {
    const auto number = [&](std::size_t column) {
      if (row.cells.size() != 5) throw InputError::format("{}:{}: expected 5 cells", path, row.line);
      const auto value = number_from_text(row.cells[column].text);
      if (!value) throw InputError::format("{}:{}: {}", path, row.line, value.error().message);
      return *value;
    };
    growth[static_cast<int>(number(0))] = {number(1), number(3), number(4)};
  }
  return growth;
}

}  // namespace

std::vector<Growth> growths_of(const Options& options, const std::string& variant) {
  std::vector<Growth> growths;
  for (int i = 0; i < options.seeds; ++i) {
    const std::string path =
        run_path(options, variant, options.first_seed + static_cast<std::uint64_t>(i)) + "-growth.csv";
    if (std::filesystem::exists(path)) growths.push_back(read_growth(path));
    if (!growths.empty() && growths.back().empty()) growths.pop_back();
  }
  return growths;
}

double hypervolume_at(const Growth& growth, int samples) {
  const auto after = growth.upper_bound(samples);
  return after == growth.begin() ? 0.0 : std::prev(after)->second.hypervolume_gpa_mpa;
}

}  // namespace nacre::search_study
