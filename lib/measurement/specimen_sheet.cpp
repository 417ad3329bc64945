#include "measurement/specimen_sheet.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/names.hpp"
#include "measurement/limits.hpp"
#include "measurement/set_files.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/tester_encoding.hpp"
#include "measurement/tester_numbers.hpp"
#include "measurement/tester_text.hpp"
#include "tester/loading.hpp"
#include "thesis/constants.hpp"

namespace nacre::measurement {
namespace {

constexpr std::array<std::string_view, 6> kRequired = {"file",     "specimen",     "pattern",
                                                       "width_mm", "thickness_mm", "gauge_mm"};
/// `loading` is an instruction to the operator: the export has the actual loading, but for the duration of pauses.
constexpr std::array<std::string_view, 17> kOptional = {"part",
                                                        "test",
                                                        "orientation_deg",
                                                        "strain_rate_per_s",
                                                        "planned_strain_rate_per_s",
                                                        "strain_amplitude",
                                                        "loading",
                                                        "batch",
                                                        "print_order",
                                                        "valid",
                                                        "extension_column",
                                                        "force_column",
                                                        "time_column",
                                                        "strain_column",
                                                        "stress_column",
                                                        "unit",
                                                        "note"};
constexpr std::array<std::string_view, 7> kMeasured = {
    "width_mm",        "thickness_mm", "gauge_mm", "orientation_deg", "strain_rate_per_s", "planned_strain_rate_per_s",
    "strain_amplitude"};
/// Kept with the specimen under their own names.
constexpr std::array<std::string_view, 6> kKept = {"date", "operator", "machine", "path", "order_id", "tray"};
/// Columns that the set computes from the export: the sheet's own columns of these names are dropped.
constexpr std::array<std::string_view, 8> kWorkedOut = {"modulus_pa",         "toughness_pa",    "curve",
                                                        "peak_stress_pa",     "failure_strain",  "toe_strain",
                                                        "initial_modulus_pa", "modulus_error_pa"};

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads the rows of one sheet.
class SheetReader {
 public:
  SheetReader(const std::string& text, const std::filesystem::path& file, bool confined)
      : file_(file.string()), folder_(file.parent_path()), confined_(confined), text_(text) {}

  SpecimenSheet read() {
    read_heading();
    find_decimal_mark();
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      cells_ = cells_of(rows_[i].text, delimiter_);
      if (std::any_of(cells_.begin(), cells_.end(), [](const auto& cell) { return !cell.empty(); })) read_row(rows_[i]);
    }
    if (sheet_.rows.empty() && sheet_.rejected.empty())
      throw InputError::format("{}: has a heading only, expected one row per specimen", file_);
    return std::move(sheet_);
  }

 private:
  /// A programme with pauses of a coupon; what else stands there is for the person.
  void keep_pauses(SpecimenRecord& record) {
    const std::string programme = text("loading");
    if (record.test != tester::TestKind::tensile || !programme.starts_with("strain")) return;
    const auto loading = tester::loading_from_string(programme);
    if (!loading) return reject("loading", loading.error().message);
    if (loading->has_pauses()) record.other_columns["loading"] = programme;
  }

  /// Empty lines, and the line in which a spreadsheet names its separator: `sep=;`.
  static bool is_before_heading(std::string_view line) {
    const std::string_view bare = trimmed(line);
    return bare.empty() || (bare.starts_with("sep=") && bare.size() <= 5);
  }

  /// Cuts the text into rows, the heading first, with the delimiter that gives the heading the most names.
  void cut() {
    for (const char delimiter : {'\t', ';', ','}) {
      std::vector<TextRow> rows = rows_of(text_, delimiter);
      while (!rows.empty() && is_before_heading(rows.front().text)) rows.erase(rows.begin());
      if (rows.empty()) throw InputError::format("{}: is empty, expected a heading and rows", file_);
      std::vector<std::string> names = cells_of(rows.front().text, delimiter);
      if (names.size() <= heading_.size()) continue;
      heading_ = std::move(names);
      rows_ = std::move(rows);
      delimiter_ = delimiter;
    }
  }

  void read_heading() {
    cut();
    const int line = rows_.front().line;
    for (const std::string_view name : kRequired) {
      if (!contains(heading_, name)) {
        throw InputError::format("{}:{}: column `{}` is missing, expected a heading with at least {}", file_, line,
                                 name, fmt::join(kRequired, ", "));
      }
    }
    std::set<std::string> seen;
    for (const std::string& name : heading_) {
      if (!name.empty() && !seen.insert(name).second)
        throw InputError::format("{}:{}: column `{}` occurs twice, expected once", file_, line, name);
      const bool known =
          contains(kRequired, name) || contains(kOptional, name) || contains(kKept, name) || name.empty();
      if (contains(kWorkedOut, name)) {
        sheet_.warnings.push_back(
            fmt::format("{}:{}: column `{}` is dropped: the measurement set has its own", file_, line, name));
      } else if (!known) {
        sheet_.warnings.push_back(fmt::format("{}:{}: unknown column `{}` is kept but not used", file_, line, name));
      }
    }
  }

  /// One decimal mark for the whole sheet, as `9,875` alone is ambiguous. Nothing when the cells contradict each other.
  void find_decimal_mark() {
    bool point = false, comma = false, any_point = false, any_comma = false;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      cells_ = cells_of(rows_[i].text, delimiter_);
      for (const std::string_view column : kMeasured) {
        const std::string cell = text(column);
        if (!looks_like_number(cell)) continue;
        const auto mark = decimal_evidence(cell);
        point = point || mark == DecimalMark::point;
        comma = comma || mark == DecimalMark::comma;
        any_point = any_point || cell.find('.') != std::string::npos;
        any_comma = any_comma || cell.find(',') != std::string::npos;
      }
    }
    if (!point && !comma && delimiter_ != ',') {  // as spreadsheets in languages with decimal commas write
      comma = any_comma;
      point = any_point;
    }
    mark_ = comma ? DecimalMark::comma : DecimalMark::point;
    if (comma && point) mark_.reset();
  }

  std::string text(std::string_view column) const {
    const auto found = std::find(heading_.begin(), heading_.end(), column);
    const auto place = static_cast<std::size_t>(found - heading_.begin());
    return place < cells_.size() && found != heading_.end() ? cells_[place] : "";
  }

  void reject(std::string_view column, std::string reason) {
    if (!fault_) fault_ = ImportFault{file_, line_, std::string(column), std::move(reason), text("specimen")};
  }

  std::optional<double> number(std::string_view column, double least, double most, std::string_view expected) {
    const std::string cell = text(column);
    if (cell.empty()) return std::nullopt;
    const auto own_mark = decimal_evidence(cell);
    if (!own_mark && !mark_ && looks_like_number(cell) && cell.find_first_of(".,") != std::string::npos) {
      reject(column, fmt::format("`{}` may have a decimal mark or grouped thousands: the sheet has decimal points and "
                                 "decimal commas, expected one of them throughout",
                                 cell));
      return std::nullopt;
    }
    const auto value = instrument_number(cell, own_mark.value_or(mark_.value_or(DecimalMark::point)));
    if (value && *value >= least && *value <= most) return value;
    reject(column, fmt::format("`{}`, expected {}", cell, expected));
    return std::nullopt;
  }

  /// 0 when it is not given.
  int integer_from_1(std::string_view column) {
    constexpr double kMost = 1e9;
    const double value = number(column, 1, kMost, "an integer from 1").value_or(0.0);
    if (value == std::floor(value)) return static_cast<int>(value);
    reject(column, fmt::format("`{}`, expected an integer from 1", text(column)));
    return 0;
  }

  double length_mm(std::string_view column) {
    if (text(column).empty()) reject(column, "is empty, expected a length in mm");
    return number(column, 1e-3, 1e4, "a length in mm, 0.001 to 10000").value_or(1.0);
  }

  pattern::Design design() {
    const std::string name = text("pattern");
    if (const auto named = pattern::design_from_name(name)) return *named;
    if (name.empty()) {
      reject("pattern",
             "is empty, expected a pattern file, a key, a coupon (rigid, soft, interface, mix:F, checkerboard:P, "
             "laminate:x|y:R:S)");
      return {};
    }
    if (confined_ && std::filesystem::path(name).filename() != name) {
      reject("pattern",
             fmt::format("`{}` leads out of the sheet's folder, expected a key, a coupon or a file in it", name));
      return {};
    }
    std::error_code unreadable;  // a name may be too long to be a file's
    const std::filesystem::path path =
        confined_ || std::filesystem::exists(folder_ / name, unreadable) ? folder_ / name : std::filesystem::path(name);
    const std::filesystem::file_status status = std::filesystem::status(path, unreadable);
    if (std::filesystem::exists(status) &&
        !std::filesystem::is_regular_file(status)) {  // a terminal or a pipe would wait for ever
      reject(
          "pattern",
          fmt::format(
              "`{}` is not a regular file, expected a pattern file, a key, or a coupon (rigid, soft, interface, mix:F, "
              "checkerboard:P, laminate:x|y:R:S)",
              name));
      return {};
    }
    try {
      return pattern::design_from_argument(path.string());
    } catch (const InputError& error) {
      reject("pattern", error.what());
      return {};
    }
  }

  void read_row(const TextRow& from) {
    line_ = from.line;
    fault_.reset();
    SheetRow row;
    row.line = from.line;
    if (from.is_torn) reject("", "the quote that opens a cell is never closed, expected a closing double quote");
    if (cells_.size() > heading_.size() && std::any_of(cells_.begin() + static_cast<std::ptrdiff_t>(heading_.size()),
                                                       cells_.end(), [](const auto& cell) { return !cell.empty(); })) {
      reject("", fmt::format("has {} cells, expected {} as in the heading", cells_.size(), heading_.size()));
    }
    row.file = text("file");
    row.record.specimen = text("specimen");
    if (row.record.specimen.empty()) reject("specimen", "is empty, expected a unique name");
    if (row.record.specimen.size() > kLongestName)
      reject("specimen", fmt::format("has {} bytes, expected at most {}", row.record.specimen.size(), kLongestName));
    if (std::ranges::any_of(row.record.specimen, is_control))
      reject("specimen", "holds a control character, expected a name that fits on a label");
    if (row.file.empty()) reject("file", "is empty, expected the name of the testing machine's export");
    if (!names_.insert(row.record.specimen).second)
      reject("specimen", fmt::format("`{}` occurs twice, expected a unique name", row.record.specimen));
    row.record.design = design();
    row.width_mm = length_mm("width_mm");
    row.record.conditions.thickness_mm = length_mm("thickness_mm");
    if (!kThicknessMm.hold(row.record.conditions.thickness_mm))
      reject("thickness_mm",
             fmt::format("`{}`, expected {} to {} mm", text("thickness_mm"), kThicknessMm.least, kThicknessMm.most));
    row.gauge_mm = length_mm("gauge_mm");
    read_optional(row);
    if (fault_) {
      sheet_.rejected.push_back(*fault_);
    } else {
      sheet_.rows.push_back(std::move(row));
    }
  }

  void read_rate(SheetRow& row) {
    const auto rate_per_s = [&](std::string_view column) {
      return number(column, kStrainRatePerS.least, kStrainRatePerS.most, "a strain rate in 1/s, 1e-9 to 1e5");
    };
    row.planned_rate_per_s = rate_per_s("planned_strain_rate_per_s");
    const auto given = rate_per_s("strain_rate_per_s");
    row.rate_is_given = given.has_value();
    double& rate = row.record.conditions.strain_rate_per_s;
    rate = given.value_or(row.planned_rate_per_s.value_or(rate));
  }

  void read_optional(SheetRow& row) {
    SpecimenRecord& record = row.record;
    const std::string test = text("test").empty() ? "toughness" : text("test");
    if (const auto kind = tester::test_kind_from_string(test)) {
      record.test = *kind;
    } else {
      reject("test", fmt::format("`{}` is not a test, expected modulus, toughness or tensile", test));
    }
    row.part = text("part");
    if (looks_like_number(row.part) && row.part.find_first_of(".,") != std::string::npos) integer_from_1("part");
    record.conditions.orientation_deg = number("orientation_deg", 0, 90, "0 or 90").value_or(0.0);
    if (record.conditions.orientation_deg != 0.0 && record.conditions.orientation_deg != 90.0)
      reject("orientation_deg", fmt::format("`{}`, expected 0 or 90", text("orientation_deg")));
    read_rate(row);
    row.strain_amplitude = number("strain_amplitude", 1e-9, 1.0, "a strain, 1e-9 to 1 (0.001 is 0.1 %)");
    record.batch = text("batch");
    record.print_order = integer_from_1("print_order");
    const std::string valid = plain_words(text("valid"));
    record.valid = valid != "0" && valid != "false";
    if (!valid.empty() && valid != "1" && valid != "true" && record.valid)
      reject("valid", fmt::format("`{}`, expected 0, 1, true or false", text("valid")));
    record.note = text("note");
    keep_pauses(record);
    if (record.valid && record.test == tester::TestKind::tensile && !record.design.mixture())
      reject("pattern", fmt::format("`{}`: {}", text("pattern"), kTensileIsHomogeneous));
    std::string extension = text("extension_column");
    const bool falls = extension.starts_with('-');
    if (falls) extension = trimmed(std::string_view(extension).substr(1));
    row.columns = {.extension = extension,
                   .force = text("force_column"),
                   .time = text("time_column"),
                   .strain = text("strain_column"),
                   .stress = text("stress_column"),
                   .extension_falls = falls,
                   .unit = text("unit")};
    for (const std::string& name : heading_) {
      if (name.empty() || contains(kRequired, name) || contains(kOptional, name) || contains(kWorkedOut, name))
        continue;
      if (!text(name).empty()) record.other_columns[name] = text(name);
    }
  }

  std::string file_;
  std::filesystem::path folder_;
  bool confined_;
  std::string_view text_;
  std::vector<TextRow> rows_;  ///< the heading first
  char delimiter_ = ',';
  std::optional<DecimalMark> mark_ = DecimalMark::point;
  std::vector<std::string> heading_, cells_;
  std::set<std::string> names_;
  int line_ = 0;
  std::optional<ImportFault> fault_;
  SpecimenSheet sheet_;
};

}  // namespace

SpecimenSheet read_specimen_sheet(const std::filesystem::path& file, bool confined) {
  const Result<std::string> text = utf8_from_instrument(read_file_up_to(file, kMostTableBytes));
  if (!text) throw InputError::format("{}: {}", file.string(), text.error().message);
  return SheetReader(*text, file, confined).read();
}

}  // namespace nacre::measurement
