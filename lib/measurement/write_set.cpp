#include "measurement/write_set.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "base/files.hpp"
#include "measurement/set_files.hpp"
#include "measurement/set_row.hpp"
#include "measurement/set_table.hpp"

namespace nacre::measurement {
namespace {

/// A unique file name made of the specimen's name, whatever characters that holds.
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

/// Names of the files in curves/: raw exports may be kept there too, and nothing is overwritten.
std::set<std::string> names_taken(const std::filesystem::path& folder) {
  std::set<std::string> taken;
  std::error_code none;  // a set need not have curves
  for (const auto& file : std::filesystem::directory_iterator(folder / "curves", none))
    taken.insert(file.path().stem().string());
  return taken;
}

/// Writes the specimens' curves and puts their rows at the end of the table.
void add_specimens(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens, SetTable& table) {
  make_folder(folder / "curves");
  std::set<std::string> taken = names_taken(folder);
  for (const SpecimenRecord& record : specimens) {
    const std::string curve = record.curve.empty() ? "" : curve_name(record.specimen, taken);
    if (!curve.empty()) write_file_atomically(folder / curve, to_csv(record.curve));
    table.append(cells_of(record, curve));
  }
  table.write(folder);  // last: a set with a table has its curves
}

}  // namespace

void write_measurement_set(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens) {
  SetTable table;
  add_specimens(folder, specimens, table);
}

void add_to_measurement_set(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens) {
  SetTable table(folder);
  for (const SpecimenRecord& record : specimens) table.remove(record.specimen);
  add_specimens(folder, specimens, table);
}

}  // namespace nacre::measurement
