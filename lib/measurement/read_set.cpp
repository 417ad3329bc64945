// Reads measurement sets. Rows are independent: what is wrong with one is reported and the others are kept.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "measurement/measurement.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_files.hpp"
#include "pattern/layout.hpp"

namespace nacre::measurement {
namespace {

constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

/// The heading: where the known columns stand, and which others there are.
struct Heading {
  std::array<std::size_t, kColumnCount> position;
  std::vector<std::pair<std::size_t, std::string>> others;
  std::size_t cell_count = 0;
};

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  return result;
}

std::string unknown_column(const std::string& table, const CsvCell& cell, const std::string& name) {
  const auto meant = std::find(kColumns.begin(), kColumns.end(), lower_case(name));
  const std::string hint = meant == kColumns.end() ? "" : fmt::format(" (is `{}` meant?)", *meant);
  return fmt::format("{}:{}:{}: unknown column `{}` is kept but not used{}", table, cell.line, cell.column, name, hint);
}

Heading read_heading(const CsvRow& row, const std::string& table, std::vector<std::string>& warnings) {
  if (!row.fault.empty()) throw InputError::format("{}:{}:{}: {}", table, row.fault_line, row.fault_column, row.fault);
  Heading heading;
  heading.position.fill(kAbsent);
  heading.cell_count = row.cells.size();
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string name(trimmed(row.cells[i].text));
    if (name.empty()) continue;
    const auto known = std::find(kColumns.begin(), kColumns.end(), name);
    const auto same = [&](const auto& other) { return other.second == name; };
    std::size_t* position =
        known == kColumns.end() ? nullptr : &heading.position[std::size_t(known - kColumns.begin())];
    if (position ? *position != kAbsent : std::any_of(heading.others.begin(), heading.others.end(), same)) {
      throw InputError::format("{}:{}: column `{}` stands twice, expected once", table, row.line, name);
    }
    if (position) {
      *position = i;
    } else {
      heading.others.emplace_back(i, name);
      warnings.push_back(unknown_column(table, row.cells[i], name));
    }
  }
  return heading;
}

void require_columns(const Heading& heading, const std::string& table, int line) {
  for (const Column required : {kSpecimen, kPattern, kTest}) {
    if (heading.position[required] == kAbsent) {
      throw InputError::format(
          "{}:{}: column `{}` is missing, expected a heading with at least specimen, pattern, test and "
          "one of modulus_pa, toughness_pa, curve (all: {})",
          table, line, kColumns[required], fmt::join(kColumns, ","));
    }
  }
  const auto absent = [&](Column column) { return heading.position[column] == kAbsent; };
  if (absent(kModulus) && absent(kToughness) && absent(kCurve)) {
    throw InputError::format("{}:{}: no measured value, expected one of the columns modulus_pa, toughness_pa, curve",
                             table, line);
  }
}

/// Turns one row into a record. The first thing that is wrong is kept as the row's fault, the rest is then skipped.
class RowParser {
 public:
  RowParser(const std::filesystem::path& folder, const Heading& heading, const CsvRow& row)
      : folder_(folder), heading_(heading), row_(row) {}

  tl::expected<SpecimenRecord, RejectedRow> parse() {
    check_shape();
    SpecimenRecord record;
    record.specimen = text(kSpecimen);
    if (record.specimen.empty()) reject(kSpecimen, "is empty, expected a unique name");
    record.test = test_kind();
    record.design = design();
    record.conditions = conditions();
    record.batch = text(kBatch);
    record.print_order = print_order();
    record.modulus_pa = positive_number(kModulus, "a modulus in Pa");
    record.toughness_pa = positive_number(kToughness, "a toughness in Pa (J/m3)");
    record.valid = validity();
    record.note = text(kNote);
    record.curve = curve();
    keep_other_columns(record);
    check_consistency(record);
    if (fault_) return tl::unexpected(*fault_);
    return record;
  }

 private:
  void reject(std::string column, int line, std::string reason) {
    if (!fault_) fault_ = RejectedRow{line, std::move(column), std::move(reason)};
  }
  void reject(Column column, const std::string& reason) {
    const std::size_t position = heading_.position[column];
    const bool there = position < row_.cells.size();
    const std::string place = there ? fmt::format(" (character {})", row_.cells[position].column) : "";
    reject(std::string(kColumns[column]), there ? row_.cells[position].line : row_.line, reason + place);
  }

  void check_shape() {
    if (!row_.fault.empty()) {
      reject(column_at(row_.cells.size()), row_.fault_line,
             fmt::format("{} (character {})", row_.fault, row_.fault_column));
      return;
    }
    std::size_t filled = row_.cells.size();
    while (filled > heading_.cell_count && trimmed(row_.cells[filled - 1].text).empty()) --filled;
    if (row_.cells.size() < heading_.cell_count || filled > heading_.cell_count) {
      reject("", row_.line,
             fmt::format("has {} cells, expected {} as in the heading", row_.cells.size(), heading_.cell_count));
    }
  }

  /// Name of the column that the `count`-th cell belongs to.
  std::string column_at(std::size_t count) const {
    for (std::size_t column = 0; column < kColumnCount; ++column) {
      if (heading_.position[column] + 1 == count) return std::string(kColumns[column]);
    }
    for (const auto& [position, name] : heading_.others) {
      if (position + 1 == count) return name;
    }
    return "";
  }

  std::string text(Column column) const {
    const std::size_t position = heading_.position[column];
    return position < row_.cells.size() ? std::string(trimmed(row_.cells[position].text)) : "";
  }

  std::optional<double> positive_number(Column column, const char* expected) {
    const std::string cell = text(column);
    if (cell.empty()) return std::nullopt;
    const Result<double> value = number_from_text(cell);
    if (!value) {
      reject(column, value.error().message);
    } else if (*value <= 0.0) {
      reject(column, fmt::format("{} is not positive, expected {}", *value, expected));
    } else {
      return *value;
    }
    return std::nullopt;
  }

  tester::TestKind test_kind() {
    const Result<tester::TestKind> kind = tester::test_kind_from_string(text(kTest));
    if (!kind) reject(kTest, fmt::format("`{}` is no test, expected modulus, toughness or tensile", text(kTest)));
    return kind.value_or(tester::TestKind::modulus);
  }

  tester::TestConditions conditions() {
    tester::TestConditions result;
    const std::string orientation = text(kOrientation);
    const Result<double> degrees = orientation.empty() ? 0.0 : number_from_text(orientation);
    if (!degrees || (*degrees != 0.0 && *degrees != 90.0)) {
      reject(kOrientation, fmt::format("`{}`, expected 0 or 90", orientation));
    } else {
      result.orientation_deg = *degrees;
    }
    result.strain_rate_per_s = positive_number(kStrainRate, "a strain rate in 1/s").value_or(result.strain_rate_per_s);
    result.thickness_mm = positive_number(kThickness, "a thickness in mm").value_or(result.thickness_mm);
    return result;
  }

  int print_order() {
    const std::string cell = text(kPrintOrder);
    if (cell.empty()) return 0;
    const Result<int> order = integer_from_text(cell);
    if (!order) reject(kPrintOrder, order.error().message);
    return order.value_or(0);
  }

  bool validity() {
    const std::string cell = lower_case(text(kValid));
    if (cell.empty() || cell == "1" || cell == "true") return true;
    if (cell != "0" && cell != "false") reject(kValid, fmt::format("`{}`, expected 0, 1, true or false", text(kValid)));
    return false;
  }

  pattern::Design design() {
    const std::string name = text(kPattern);
    if (name.empty()) {
      reject(kPattern, "is empty, expected a pattern file, a key, rigid, soft, interface or mix:F");
      return {};
    }
    const Result<pattern::Design> named = pattern::design_from_name(name);
    if (named) return *named;
    const Result<std::filesystem::path> path = file_inside(folder_, name);
    if (!path) {
      reject(kPattern,
             fmt::format("{}; expected a key, rigid, soft, interface, mix:F with 0 <= F <= 1, or a file of the set: {}",
                         named.error().message, path.error().message));
      return {};
    }
    return design_of_file(*path, name);
  }

  pattern::Design design_of_file(const std::filesystem::path& path, const std::string& name) {
    try {
      const Result<pattern::Layout> layout = pattern::layout_from_text(read_file_up_to(path, kMostLayoutBytes), name);
      if (layout) return *layout;
      reject(kPattern, layout.error().message);
    } catch (const InputError& error) {
      reject(kPattern, error.what());
    }
    return {};
  }

  tester::Curve curve() {
    const std::string name = text(kCurve);
    if (name.empty() || fault_) return {};
    const Result<std::filesystem::path> path = file_inside(folder_, name);
    if (!path) {
      reject(kCurve, path.error().message);
      return {};
    }
    Result<tester::Curve> curve = read_curve(*path, name);
    if (!curve) reject(kCurve, curve.error().message);
    return std::move(curve).value_or(tester::Curve{});
  }

  void keep_other_columns(SpecimenRecord& record) const {
    for (const auto& [position, name] : heading_.others) {
      if (position >= row_.cells.size() || row_.cells[position].text.empty()) continue;
      record.other_columns[name] = row_.cells[position].text;
    }
  }

  /// Every test needs a value of its own kind; the notched specimen says nothing of the modulus, and a modulus test
  /// nothing of the toughness.
  void check_consistency(const SpecimenRecord& record) {
    if (fault_) return;
    if (record.test == tester::TestKind::modulus && !modulus_of(record)) {
      reject(kModulus, "no modulus, expected modulus_pa, or a curve that rises between 0.05 and 0.25 % strain");
    }
    if (record.test == tester::TestKind::toughness && !record.toughness_pa) {
      if (record.curve.empty()) reject(kToughness, "no toughness, expected toughness_pa or a curve");
      if (!record.curve.empty() && tester::area_under(record.curve) <= 0.0) {
        reject(kCurve, "the area under the curve is not positive, expected a stress-strain curve to separation");
      }
    }
    if (record.test != tester::TestKind::tensile) return;
    if (record.curve.empty()) reject(kCurve, "no curve, expected one for a tensile test");
    if (!record.design.mixture())
      reject(kPattern, "a tensile coupon is homogeneous, expected rigid, soft, interface or mix:F");
  }

  const std::filesystem::path& folder_;
  const Heading& heading_;
  const CsvRow& row_;
  std::optional<RejectedRow> fault_;
};

/// Doubts about a usable row, each as a sentence that begins with its place.
void collect_warnings(const SpecimenRecord& record, const std::string& place, std::vector<std::string>& warnings) {
  constexpr double kAreaTolerance = 0.02, kLeastPlausiblePa = 1e4, kMostPlausiblePa = 1e11;
  const bool notched = record.test == tester::TestKind::toughness;
  if (notched && record.toughness_pa && !record.curve.empty()) {
    const double area = tester::area_under(record.curve);
    if (std::abs(area - *record.toughness_pa) > kAreaTolerance * *record.toughness_pa) {
      warnings.push_back(
          fmt::format("{}: column toughness_pa: {} is {:.1f} % off the area under the curve, {}; expected at "
                      "most 2 %; the given value is used",
                      place, *record.toughness_pa, 100.0 * std::abs(area / *record.toughness_pa - 1.0), area));
    }
  }
  const auto warn_ignored = [&](const char* column) {
    warnings.push_back(
        fmt::format("{}: column {}: is not used in a {} test", place, column, tester::to_string(record.test)));
  };
  if (record.modulus_pa && record.test != tester::TestKind::modulus) warn_ignored("modulus_pa");
  if (record.toughness_pa && !notched) warn_ignored("toughness_pa");
  const std::optional<double> modulus = modulus_of(record);
  if (modulus && (*modulus < kLeastPlausiblePa || *modulus > kMostPlausiblePa)) {
    warnings.push_back(
        fmt::format("{}: column modulus_pa: {} Pa is no usual modulus; is the unit Pa?", place, *modulus));
  }
}

/// Reads rows one after another into a set, and keeps specimen names unique.
class SetBuilder {
 public:
  SetBuilder(std::filesystem::path folder, std::string table) : folder_(std::move(folder)), table_(std::move(table)) {}

  MeasurementSet read(std::string_view text) {
    CsvLimits limits;
    limits.rows = kMostTableRows;
    CsvReader reader(text, table_, limits);
    CsvRow row;
    do {
      if (!reader.next(row)) throw InputError::format("{}: is empty, expected a heading and rows", table_);
    } while (row.blank());
    const Heading heading = read_heading(row, table_, set_.warnings);
    require_columns(heading, table_, row.line);
    while (reader.next(row)) {
      if (!row.blank()) add(heading, row);
    }
    if (set_.specimens.empty()) throw nothing_usable();
    return std::move(set_);
  }

 private:
  void add(const Heading& heading, const CsvRow& row) {
    if (point_count_ > kMostSetPoints) {
      throw InputError::format("{}:{}: the curves have more than {} points together, expected at most that many", table_,
                               row.line, kMostSetPoints);
    }
    const tl::expected<SpecimenRecord, RejectedRow> record = RowParser(folder_, heading, row).parse();
    if (!record) {
      set_.rejected.push_back(record.error());
      return;
    }
    const std::string place = fmt::format("{}:{}", table_, row.line);
    const auto [known, is_new] = index_of_.try_emplace(record->specimen, set_.specimens.size(), row.line);
    const auto [index, first_line] = known->second;
    if (is_new) {
      point_count_ += record->curve.size();
      set_.specimens.push_back(*record);
      collect_warnings(*record, place, set_.warnings);
    } else if (set_.specimens[index] == *record) {
      set_.warnings.push_back(
          fmt::format("{}: specimen `{}` repeats line {} and is ignored", place, record->specimen, first_line));
    } else {
      set_.rejected.push_back({row.line, "specimen",
                               fmt::format("`{}` stands in line {} with other content, expected a unique name",
                                           record->specimen, first_line)});
    }
  }

  InputError nothing_usable() const {
    if (set_.rejected.empty())
      return InputError::format("{}: has a heading only, expected one row per specimen", table_);
    const RejectedRow& first = set_.rejected.front();
    const std::string column = first.column.empty() ? "" : fmt::format(" column {}:", first.column);
    return InputError::format("{}: none of {} rows is usable; the first, line {}:{} {}", table_, set_.rejected.size(),
                              first.line, column, first.reason);
  }

  std::filesystem::path folder_;
  std::string table_;
  MeasurementSet set_;
  std::size_t point_count_ = 0;
  std::map<std::string, std::pair<std::size_t, int>> index_of_;  ///< specimen -> index, line
};

}  // namespace

MeasurementSet read_measurement_set(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError::format("{}: is no folder, expected a measurement set: a folder with {}", folder.string(),
                             kTableName);
  }
  const Result<std::filesystem::path> table = file_inside(folder, kTableName);
  const std::string shown_name = (folder / kTableName).string();
  if (!table) throw InputError::format("{}: {}", shown_name, table.error().message);
  return SetBuilder(folder, shown_name).read(read_file_up_to(*table, kMostTableBytes));
}

}  // namespace nacre::measurement
