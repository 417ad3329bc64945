#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "measurement/measurement.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_files.hpp"

namespace nacre::measurement {
namespace {

/// A file name that says which specimen it is, whatever characters the specimen's name holds, and that no other one
/// took.
std::string curve_name(const std::string& specimen, std::set<std::string>& taken) {
  constexpr std::size_t kMostLetters = 100;
  std::string name;
  for (const char letter : specimen.substr(0, kMostLetters)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '_';
    name += plain || (letter == '.' && !name.empty()) ? letter : '_';
  }
  std::string unique = name;
  for (int copy = 2; !taken.insert(unique).second; ++copy) unique = fmt::format("{}~{}", name, copy);
  return fmt::format("curves/{}.csv", unique);
}

std::string optional_number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::string table_row(const SpecimenRecord& record, const std::string& curve, const std::set<std::string>& others) {
  std::string row = fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_cell(record.specimen), csv_cell(record.design.name()),
      tester::to_string(record.test), record.conditions.orientation_deg, record.conditions.strain_rate_per_s,
      csv_cell(record.batch), record.print_order == 0 ? "" : std::to_string(record.print_order),
      record.conditions.thickness_mm, optional_number(record.modulus_pa), optional_number(record.toughness_pa),
      csv_cell(curve), record.valid ? 1 : 0, csv_cell(record.note));
  for (const std::string& name : others) {
    const auto cell = record.other_columns.find(name);
    row += "," + (cell == record.other_columns.end() ? "" : csv_cell(cell->second));
  }
  return row + "\n";
}

void create_folders(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw InputError::format("{}: cannot be created: {}", folder.string(), failure.message());
}

}  // namespace

void write_measurement_set(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens) {
  create_folders(folder / "curves");
  std::set<std::string> others;
  for (const SpecimenRecord& record : specimens) {
    for (const auto& [name, text] : record.other_columns) others.insert(name);
  }
  std::string table;
  for (const std::string_view column : kColumns) table += (table.empty() ? "" : ",") + std::string(column);
  for (const std::string& name : others) table += "," + csv_cell(name);
  table += "\n";
  std::set<std::string> taken;
  for (const SpecimenRecord& record : specimens) {
    const std::string curve = record.curve.empty() ? "" : curve_name(record.specimen, taken);
    if (!curve.empty()) write_file_atomically(folder / curve, to_csv(record.curve));
    table += table_row(record, curve, others);
  }
  write_file_atomically(folder / kTableName, table);  // last: a set with a table has its curves
}

}  // namespace nacre::measurement
