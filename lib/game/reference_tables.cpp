#include "game/reference_tables.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::game {
namespace {

// A table whose cells are asked for by row and column name.
class Table {
 public:
  Table(std::filesystem::path path, const std::vector<std::string>& required) : path_(std::move(path)) {
    const std::string text = read_file(path_);
    CsvReader reader(text, path_.string());
    for (CsvRow row; reader.next(row);) {
      if (!row.fault.empty()) {
        throw InputError::format("{}:{}:{}: {}", path_.string(), row.fault_line, row.fault_column, row.fault);
      }
      if (row.blank()) continue;
      if (columns_.empty()) {
        read_header(row, required);
      } else {
        rows_.push_back(std::move(row));
      }
    }
    if (rows_.empty()) {
      throw InputError::format("{}: no rows; expected a header with {} and at least one row", path_.string(),
                               fmt::join(required, ", "));
    }
  }

  std::size_t size() const { return rows_.size(); }

  const std::string& text(std::size_t row, const std::string& column) const {
    const std::size_t index = columns_.at(column);
    if (index >= rows_[row].cells.size()) fail_at(row, column, "the cell is missing");
    return rows_[row].cells[index].text;
  }

  double positive(std::size_t row, const std::string& column) const {
    const auto value = number_from_text(text(row, column));
    if (!value || *value <= 0.0) fail_at(row, column, "expected a positive number, found '" + text(row, column) + "'");
    return *value;
  }

  [[noreturn]] void fail_at(std::size_t row, const std::string& column, const std::string& what) const {
    throw InputError::format("{}:{}: column {}: {}", path_.string(), rows_[row].line, column, what);
  }

 private:
  void read_header(const CsvRow& header, const std::vector<std::string>& required) {
    for (std::size_t index = 0; index < header.cells.size(); ++index) columns_.emplace(header.cells[index].text, index);
    for (const std::string& name : required) {
      if (!columns_.contains(name)) {
        throw InputError::format("{}:{}: column {} is missing; expected {}", path_.string(), header.line, name,
                                 fmt::join(required, ", "));
      }
    }
  }

  std::filesystem::path path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<CsvRow> rows_;
};

constexpr std::pair<const char*, double> kRigidFractions[] = {{"TB", 0.0}, {"VW", 1.0}, {"IF", 0.5}};

measurement::Replicates read_material(const Table& table, std::size_t row, double rigid_fraction) {
  measurement::Replicates measured;
  measured.design = pattern::Mixture{rigid_fraction};
  measured.modulus_count = measured.toughness_count = 1;
  measured.modulus_pa = 1e9 * table.positive(row, "measured_modulus_gpa");
  measured.toughness_pa = 1e6 * table.positive(row, "measured_toughness_mpa");
  return measured;
}

}  // namespace

std::vector<measurement::Replicates> read_base_materials(const std::filesystem::path& path) {
  const Table table(path, {"material", "measured_modulus_gpa", "measured_toughness_mpa"});
  std::map<std::string, measurement::Replicates> found;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::string& name = table.text(row, "material");
    const auto* known = std::find_if(std::begin(kRigidFractions), std::end(kRigidFractions),
                                     [&](const auto& each) { return name == each.first; });
    if (known == std::end(kRigidFractions))
      table.fail_at(row, "material", "expected TB, VW or IF, found '" + name + "'");
    if (!found.emplace(name, read_material(table, row, known->second)).second) {
      table.fail_at(row, "material", name + " stands here a second time");
    }
  }
  std::vector<measurement::Replicates> materials;
  for (const auto& [name, rigid_fraction] : kRigidFractions) {
    if (!found.contains(name)) {
      throw InputError::format("{}: no row for material {}; expected TB, VW and IF", path.string(), name);
    }
    materials.push_back(found.at(name));
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
