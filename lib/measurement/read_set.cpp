#include "measurement/read_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/names.hpp"
#include "measurement/consistency.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_files.hpp"
#include "measurement/set_row.hpp"
#include "measurement/specimen_checks.hpp"

namespace nacre::measurement {
namespace {

std::string unknown_column(const std::string& table, const CsvCell& cell, const std::string& name) {
  const auto meant = std::find(kColumns.begin(), kColumns.end(), lower_case(name));
  const std::string hint = meant == kColumns.end() ? "" : fmt::format(" (is `{}` meant?)", *meant);
  return fmt::format("{}:{}:{}: unknown column `{}` is kept but not used{}", table, cell.line, cell.column, name, hint);
}

/// The name under which an unknown column is kept: a second `x` is `x~2`, so that neither is lost.
std::string name_of_its_own(const SetHeading& heading, const std::string& name) {
  const auto is_taken = [&](const std::string& wanted) {
    return std::ranges::any_of(heading.others, [&](const auto& other) { return other.second == wanted; });
  };
  std::string kept = name;
  for (int number = 2; is_taken(kept); ++number) kept = fmt::format("{}~{}", name, number);
  return kept;
}

SetHeading read_heading(const CsvRow& row, const std::string& table, std::vector<std::string>& warnings) {
  if (!row.fault.empty()) throw InputError::format("{}:{}:{}: {}", table, row.fault_line, row.fault_column, row.fault);
  SetHeading heading;
  heading.position.fill(kAbsent);
  heading.cell_count = row.cells.size();
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string name(trimmed(row.cells[i].text));
    if (name.empty()) continue;
    const auto known = std::find(kColumns.begin(), kColumns.end(), name);
    if (known != kColumns.end()) {
      std::size_t& position = heading.position[std::size_t(known - kColumns.begin())];
      if (position != kAbsent)
        throw InputError::format("{}:{}: column `{}` occurs twice, expected once", table, row.line, name);
      position = i;
      continue;
    }
    const std::string kept = name_of_its_own(heading, name);
    heading.others.emplace_back(i, kept);
    if (std::ranges::find(kHistoryColumns, kept) == kHistoryColumns.end() &&
        std::ranges::find(kConditionColumns, kept) == kConditionColumns.end())
      warnings.push_back(unknown_column(table, row.cells[i], kept));
  }
  return heading;
}

void require_columns(const SetHeading& heading, const CsvRow& row, const std::string& table, bool planned) {
  const int line = row.line;
  for (const SetColumn required : {kSpecimen, kPattern, kTest}) {
    if (heading.position[required] == kAbsent) {
      throw InputError::format(
          "{}:{}: column `{}` is missing, expected a heading with at least specimen, pattern, test and "
          "one of modulus_pa, toughness_pa, curve (all: {}){}",
          table, line, kColumns[required], fmt::join(kColumns, ","), other_separator(row));
    }
  }
  if (planned) return;
  const auto absent = [&](SetColumn column) { return heading.position[column] == kAbsent; };
  if (absent(kModulus) && absent(kToughness) && absent(kCurve)) {
    throw InputError::format("{}:{}: no measured value, expected one of the columns modulus_pa, toughness_pa, curve",
                             table, line);
  }
}

/// What a row must hold: a test alone, a measured value, or a plausible one.
enum class Demand { planned, measured, plausible };

/// Reads rows one after another into a set, and keeps specimen names unique.
class SetBuilder {
 public:
  SetBuilder(std::filesystem::path folder, std::string table, Demand demand)
      : folder_(std::move(folder)), table_(std::move(table)), demand_(demand) {}

  MeasurementSet read(std::string_view text) {
    CsvLimits limits;
    limits.rows = kMostTableRows;
    CsvReader reader(text, table_, limits);
    CsvRow row;
    do {
      if (!reader.next(row)) throw InputError::format("{}: is empty, expected a heading and rows", table_);
    } while (row.blank());
    const SetHeading heading = read_heading(row, table_, set_.warnings);
    require_columns(heading, row, table_, demand_ == Demand::planned);
    while (reader.next(row)) {
      if (!row.blank()) add(heading, row);
    }
    if (set_.specimens.empty()) throw nothing_usable();
    for (const UnitDoubt& doubt : doubts_of_units(set_.specimens))
      set_.warnings.push_back(fmt::format("{}: {}", table_, doubt.text));
    return std::move(set_);
  }

 private:
  void add(const SetHeading& heading, const CsvRow& row) {
    if (point_count_ > kMostSetPoints) {
      throw InputError::format("{}:{}: the curves have more than {} points together, expected at most that many",
                               table_, row.line, kMostSetPoints);
    }
    const tl::expected<SpecimenRecord, RejectedRow> record =
        parse_row(folder_, heading, row, demand_ == Demand::planned);
    if (!record) {
      set_.rejected.push_back(record.error());
      return;
    }
    if (auto implausible = implausible_value(*record); implausible && demand_ == Demand::plausible && record->valid) {
      implausible->line = row.line;
      set_.rejected.push_back(*std::move(implausible));
      return;
    }
    const std::string place = fmt::format("{}:{}", table_, row.line);
    if (const std::size_t at = heading.position[kPrintOrder];
        at < row.cells.size() && !row.cells[at].text.empty() && record->print_order == 0)
      set_.warnings.push_back(
          fmt::format("{}: column print_order: {} counts as unknown, count from 1", place, row.cells[at].text));
    const auto [known, is_new] = index_of_.try_emplace(record->specimen, set_.specimens.size(), row.line);
    const auto [index, first_line] = known->second;
    if (is_new) {
      point_count_ += record->curve.size();
      set_.specimens.push_back(*record);
      set_.lines.push_back(row.line);
      for (const std::string& doubt : doubts_about(*record)) set_.warnings.push_back(place + ": " + doubt);
    } else if (set_.specimens[index] == *record) {
      set_.warnings.push_back(
          fmt::format("{}: specimen `{}` repeats line {} and is ignored", place, record->specimen, first_line));
    } else {
      set_.rejected.push_back(
          {row.line, "specimen",
           fmt::format("`{}` is in line {} with other content, expected a unique name", record->specimen, first_line)});
    }
  }

  InputError nothing_usable() const {
    if (set_.rejected.empty())
      return InputError::format("{}: has a heading only, expected one row per specimen", table_);
    constexpr std::size_t kMostShown = 20;
    std::string reasons;
    for (const RejectedRow& row : std::span(set_.rejected).first(std::min(kMostShown, set_.rejected.size())))
      reasons += fmt::format("\n  line {}:{} {}", row.line,
                             row.column.empty() ? "" : fmt::format(" column {}:", row.column), row.reason);
    if (set_.rejected.size() > kMostShown) reasons += fmt::format("\n  and {} more", set_.rejected.size() - kMostShown);
    return InputError::format("{}: none of {} rows is usable:{}", table_, set_.rejected.size(), reasons);
  }

  std::filesystem::path folder_;
  std::string table_;
  Demand demand_;
  MeasurementSet set_;
  std::size_t point_count_ = 0;
  std::map<std::string, std::pair<std::size_t, int>> index_of_;  ///< specimen -> index, line
};

MeasurementSet read_set(const std::filesystem::path& folder, Demand demand) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError::format("{}: is not a folder, expected a measurement set: a folder with {}", folder.string(),
                             kTableName);
  }
  const Result<std::filesystem::path> table = file_inside(folder, kTableName);
  const std::string shown_name = (folder / kTableName).string();
  if (!table) throw InputError::format("{}: {}", shown_name, table.error().message);
  return SetBuilder(folder, shown_name, demand).read(read_file_up_to(*table, kMostTableBytes));
}

}  // namespace

MeasurementSet read_measurement_set(const std::filesystem::path& folder) { return read_set(folder, Demand::measured); }

MeasurementSet read_plausible_set(const std::filesystem::path& folder) { return read_set(folder, Demand::plausible); }

MeasurementSet read_planned_set(const std::filesystem::path& folder) { return read_set(folder, Demand::planned); }

}  // namespace nacre::measurement
