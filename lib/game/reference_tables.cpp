#include "game/reference_tables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include <fmt/ranges.h>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::game {
namespace {

// A small table of plain cells (no quoting: names and numbers only).
class Table {
 public:
  Table(std::filesystem::path path, const std::vector<std::string>& required) : path_(std::move(path)) {
    const std::string text = read_file(path_);
    int line_number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string_view line(text.data() + begin, end - begin);
      begin = end + 1;
      ++line_number;
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      if (line.empty() || line.front() == '#') continue;
      if (columns_.empty()) {
        read_header(line, line_number, required);
      } else {
        rows_.push_back({line_number, split(line)});
      }
    }
    if (rows_.empty()) throw InputError::format("{}: no rows; expected a header with {} and at least one row", path_.string(),
                                                fmt::join(required, ", "));
  }

  std::size_t size() const { return rows_.size(); }
  int line(std::size_t row) const { return rows_[row].line; }

  std::string cell(std::size_t row, const std::string& column) const {
    const std::size_t index = columns_.at(column);
    if (index >= rows_[row].cells.size()) fail_at(row, column, "the cell is missing");
    return rows_[row].cells[index];
  }

  double positive(std::size_t row, const std::string& column) const {
    const std::string text = cell(row, column);
    double value = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) || value <= 0.0) {
      fail_at(row, column, "expected a positive number, found '" + text + "'");
    }
    return value;
  }

  [[noreturn]] void fail_at(std::size_t row, const std::string& column, const std::string& what) const {
    throw InputError::format("{}:{}: column {}: {}", path_.string(), rows_[row].line, column, what);
  }

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };

  static std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> cells;
    while (true) {
      const std::size_t comma = line.find(',');
      cells.emplace_back(line.substr(0, comma));
      if (comma == std::string_view::npos) return cells;
      line.remove_prefix(comma + 1);
    }
  }

  void read_header(std::string_view line, int line_number, const std::vector<std::string>& required) {
    const std::vector<std::string> names = split(line);
    for (std::size_t index = 0; index < names.size(); ++index) columns_.emplace(names[index], index);
    for (const std::string& name : required) {
      if (!columns_.contains(name)) {
        throw InputError::format("{}:{}: column {} is missing; expected {}", path_.string(), line_number, name,
                                 fmt::join(required, ", "));
      }
    }
  }

  std::filesystem::path path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<Row> rows_;
};

}  // namespace

std::vector<measurement::Replicates> read_base_materials(const std::filesystem::path& path) {
  const Table table(path, {"material", "measured_modulus_gpa", "measured_toughness_mpa"});
  const std::map<std::string, double> rigid_fractions = {{"TB", 0.0}, {"VW", 1.0}, {"IF", 0.5}};
  std::vector<measurement::Replicates> materials;
  for (const std::string name : {"TB", "VW", "IF"}) {
    bool found = false;
    for (std::size_t row = 0; row < table.size(); ++row) {
      const std::string material = table.cell(row, "material");
      if (!rigid_fractions.contains(material)) table.fail_at(row, "material", "expected TB, VW or IF, found '" + material + "'");
      if (material != name) continue;
      if (found) table.fail_at(row, "material", material + " stands here a second time");
      found = true;
      measurement::Replicates measured;
      measured.design = pattern::Mixture{rigid_fractions.at(name)};
      measured.modulus_count = measured.toughness_count = 1;
      measured.modulus_pa = 1e9 * table.positive(row, "measured_modulus_gpa");
      measured.toughness_pa = 1e6 * table.positive(row, "measured_toughness_mpa");
      materials.push_back(std::move(measured));
    }
    if (!found) throw InputError::format("{}: no row for material {}; expected TB, VW and IF", path.string(), name);
  }
  return materials;
}

std::vector<optimize::Performance> read_benchmark_line(const std::filesystem::path& path) {
  const Table table(path, {"modulus_gpa", "toughness_mpa"});
  std::vector<optimize::Performance> line;
  for (std::size_t row = 0; row < table.size(); ++row) {
    line.push_back({1e9 * table.positive(row, "modulus_gpa"), 1e6 * table.positive(row, "toughness_mpa")});
  }
  std::stable_sort(line.begin(), line.end(), [](const auto& a, const auto& b) { return a.modulus_pa < b.modulus_pa; });
  return line;
}

}  // namespace nacre::game
