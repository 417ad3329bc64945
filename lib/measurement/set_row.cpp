#include "measurement/set_row.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/names.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/limits.hpp"
#include "measurement/pauses.hpp"
#include "measurement/set_files.hpp"
#include "measurement/specimen_checks.hpp"
#include "pattern/coupons.hpp"
#include "pattern/layout.hpp"

namespace nacre::measurement {
namespace {

/// Turns one row into a record. The first fault is kept as the row's fault, the rest is then skipped.
class RowParser {
 public:
  RowParser(const std::filesystem::path& folder, const SetHeading& heading, const CsvRow& row, bool planned,
            const CurveSource& curves)
      : folder_(folder), heading_(heading), row_(row), planned_(planned), curves_(curves) {}

  tl::expected<SpecimenRecord, RejectedRow> parse() {
    check_shape();
    SpecimenRecord record;
    record.specimen = text(kSpecimen);
    if (record.specimen.empty()) reject(kSpecimen, "is empty, expected a unique name");
    if (record.specimen.size() > kLongestName)
      reject(kSpecimen,
             fmt::format("has {} bytes, expected a name of at most {}", record.specimen.size(), kLongestName));
    if (std::ranges::any_of(record.specimen, is_control))
      reject(kSpecimen, "holds a control character, expected a name that fits on a label");
    record.test = test_kind();
    record.design = design();
    record.conditions = conditions();
    record.batch = text(kBatch);
    record.print_order = print_order();
    record.modulus_pa = positive_number(kModulus, "a modulus in Pa", {0.0, kModulusPa.most});
    record.toughness_pa = positive_number(kToughness, "a toughness in Pa (J/m3)", {0.0, kToughnessPa.most});
    record.valid = validity();
    record.note = text(kNote);
    record.curve = curve();
    keep_other_columns(record);
    put_hold(record);
    check_loading(record);
    check_consistency(record);
    if (fault_) return tl::unexpected(*fault_);
    return record;
  }

 private:
  void reject(std::string column, int line, std::string reason) {
    if (!fault_) fault_ = RejectedRow{line, std::move(column), std::move(reason)};
  }
  void reject(SetColumn column, const std::string& reason) {
    const std::size_t position = heading_.position[column];
    const bool there = position < row_.cells.size();
    const std::string place =
        there && row_.cells[position].column > 0 ? fmt::format(" (character {})", row_.cells[position].column) : "";
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

  std::string text(SetColumn column) const {
    const std::size_t position = heading_.position[column];
    return position < row_.cells.size() ? std::string(trimmed(row_.cells[position].text)) : "";
  }

  std::optional<double> positive_number(SetColumn column, const char* expected, const Limits& limits) {
    const std::string cell = text(column);
    if (cell.empty()) return std::nullopt;
    const Result<double> value = number_from_text(cell);
    if (!value) {
      reject(column, value.error().message);
    } else if (*value <= 0.0) {
      reject(column, fmt::format("{} is not positive, expected {}", *value, expected));
    } else if (!limits.hold(*value)) {
      reject(column, fmt::format("{}, expected {} from {} to {}", *value, expected, limits.least, limits.most));
    } else {
      return *value;
    }
    return std::nullopt;
  }

  tester::TestKind test_kind() {
    const Result<tester::TestKind> kind = tester::test_kind_from_string(text(kTest));
    if (!kind) reject(kTest, fmt::format("`{}` is not a test, expected modulus, toughness or tensile", text(kTest)));
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
    const auto rate_per_s = positive_number(kStrainRate, "a strain rate in 1/s", kStrainRatePerS);
    const auto thickness_mm = positive_number(kThickness, "a thickness in mm", kThicknessMm);
    result.strain_rate_per_s = rate_per_s.value_or(result.strain_rate_per_s);
    result.thickness_mm = thickness_mm.value_or(result.thickness_mm);
    return result;
  }

  int print_order() {
    const std::string cell = text(kPrintOrder);
    if (cell.empty()) return 0;
    const Result<int> order = integer_from_text(cell);
    if (!order) {
      reject(kPrintOrder, order.error().message);
    }
    return std::max(0, order.value_or(0));  // 0: unknown
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
      reject(kPattern,
             "is empty, expected a pattern file, a key, a coupon (rigid, soft, interface, mix:F, checkerboard:P, "
             "laminate:x|y:R:S)");
      return {};
    }
    const Result<pattern::Design> named = pattern::design_from_word(name);
    if (named) return *named;
    if (pattern::coupon_from_name(name)) {
      reject(kPattern, named.error().message);
      return {};
    }
    const Result<std::filesystem::path> path = file_inside(folder_, name);
    if (!path) {
      reject(
          kPattern,
          fmt::format(
              "{}; expected a key, rigid, soft, interface, mix:F with 0 <= F <= 1, a coupon, or a file of the set: {}",
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
    Result<tester::Curve> curve = curves_ ? curves_(name) : curve_of_set(name);
    if (!curve) reject(kCurve, curve.error().message);
    return std::move(curve).value_or(tester::Curve{});
  }

  Result<tester::Curve> curve_of_set(const std::string& name) const {
    const Result<std::filesystem::path> path = file_inside(folder_, name);
    if (!path) return tl::unexpected(path.error());
    return read_curve(*path, name);
  }

  void keep_other_columns(SpecimenRecord& record) const {
    for (const auto& [position, name] : heading_.others) {
      if (position >= row_.cells.size() || row_.cells[position].text.empty()) continue;
      record.other_columns[name] = row_.cells[position].text;
    }
  }

  /// A strain that is held has no rate: that of a pull which is as stiff stands for its time.
  void put_hold(SpecimenRecord& record) {
    const auto cell = record.other_columns.find(std::string(kHoldColumn));
    if (cell == record.other_columns.end()) return;
    const auto refuse = [&](const std::string& reason) { reject(std::string(kHoldColumn), row_.line, reason); };
    const Result<double> time_s = number_from_text(trimmed(cell->second));
    if (!time_s || !(*time_s > 0.0) || !kStrainRatePerS.hold(rate_of_hold(*time_s)))
      return refuse(fmt::format("`{}`, expected a time in s from {:.1g} to {:.1g}", cell->second,
                                rate_of_hold(kStrainRatePerS.most), rate_of_hold(kStrainRatePerS.least)));
    if (record.test != tester::TestKind::modulus || !record.design.mixture() || (!record.modulus_pa && !planned_))
      return refuse("expected a modulus_pa of the test `modulus` of a homogeneous material, its relaxation modulus");
    const double rate_per_s = rate_of_hold(*time_s);
    if (text(kStrainRate).empty()) record.conditions.strain_rate_per_s = rate_per_s;
    constexpr double kRounding = 0.01;
    if (std::abs(record.conditions.strain_rate_per_s / rate_per_s - 1.0) > kRounding)
      reject(kStrainRate, fmt::format("{} with a strain that was held for {} s, expected an empty cell or {:.4g}",
                                      record.conditions.strain_rate_per_s, *time_s, rate_per_s));
  }

  void check_loading(const SpecimenRecord& record) {
    if (record.test != tester::TestKind::tensile) return;
    if (const auto loading = pauses_of(record); !loading)
      reject(std::string(kLoadingColumn), row_.line, loading.error().message);
  }

  /// A notched specimen does not determine the modulus, nor a modulus test the toughness.
  void check_consistency(const SpecimenRecord& record) {
    if (fault_ || planned_ || !record.valid) return;  // a failed test need not have a result
    const std::optional<RejectedRow> missing = missing_result(record);
    if (!missing) return;
    const auto column = std::ranges::find(kColumns, missing->column);
    reject(static_cast<SetColumn>(column - std::begin(kColumns)), missing->reason);
  }

  const std::filesystem::path& folder_;
  const SetHeading& heading_;
  const CsvRow& row_;
  bool planned_;
  const CurveSource& curves_;
  std::optional<RejectedRow> fault_;
};

}  // namespace

tl::expected<SpecimenRecord, RejectedRow> parse_row(const std::filesystem::path& folder, const SetHeading& heading,
                                                    const CsvRow& row, bool planned, const CurveSource& curves) {
  return RowParser(folder, heading, row, planned, curves).parse();
}

namespace {

std::string optional_number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

}  // namespace

std::map<std::string, std::string> cells_of(const SpecimenRecord& record, const std::string& curve) {
  std::map<std::string, std::string> cells = {
      {"specimen", record.specimen},
      {"pattern", record.design.name()},
      {"test", std::string(tester::to_string(record.test))},
      {"orientation_deg", fmt::format("{}", record.conditions.orientation_deg)},
      {"strain_rate_per_s", fmt::format("{}", record.conditions.strain_rate_per_s)},
      {"batch", record.batch},
      {"print_order", record.print_order == 0 ? "" : std::to_string(record.print_order)},
      {"thickness_mm", fmt::format("{}", record.conditions.thickness_mm)},
      {"modulus_pa", optional_number(record.modulus_pa)},
      {"toughness_pa", optional_number(record.toughness_pa)},
      {"curve", curve},
      {"valid", record.valid ? "1" : "0"},
      {"note", record.note}};
  cells.insert(record.other_columns.begin(), record.other_columns.end());
  return cells;
}

}  // namespace nacre::measurement
