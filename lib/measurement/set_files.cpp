#include "measurement/set_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "measurement/limits.hpp"

namespace nacre::measurement {
namespace {

/// Positions of the two columns of a curve.
struct CurveColumns {
  std::size_t strain = 0;
  std::size_t stress = 0;
};

Result<CurveColumns> find_columns(const CsvRow& header, const std::string& shown_name) {
  if (!header.fault.empty()) {
    return fail("{}:{}:{}: {}", shown_name, header.fault_line, header.fault_column, header.fault);
  }
  std::optional<std::size_t> strain, stress;
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::string_view name = trimmed(header.cells[i].text);
    std::optional<std::size_t>* found = name == "strain" ? &strain : name == "stress_pa" ? &stress : nullptr;
    if (found == nullptr) continue;
    if (*found) return fail("{}:{}: column `{}` occurs twice, expected once", shown_name, header.line, name);
    *found = i;
  }
  if (!strain || !stress) {
    return fail("{}:{}: expected a heading with the columns `strain,stress_pa`{}", shown_name, header.line,
                other_separator(header));
  }
  return CurveColumns{*strain, *stress};
}

Result<double> number_at(const CsvRow& row, std::size_t index, const char* column, const std::string& shown_name) {
  if (index >= row.cells.size()) {
    return fail("{}:{}: column {}: the cell is empty, expected a number", shown_name, row.line, column);
  }
  const CsvCell& cell = row.cells[index];
  const Result<double> value = number_from_text(cell.text);
  if (!value) return fail("{}:{}:{}: column {}: {}", shown_name, cell.line, cell.column, column, value.error().message);
  return value;
}

}  // namespace

Result<std::filesystem::path> file_inside(const std::filesystem::path& folder, std::string_view name) {
  const std::filesystem::path relative{std::string(name)};
  if (name.find('\0') != std::string_view::npos) return fail("a file name holds a zero byte");
  if (relative.is_absolute()) return fail("`{}` is an absolute path, expected one relative to the set", name);
  if (std::find(relative.begin(), relative.end(), "..") != relative.end()) {
    return fail("`{}` leads outside the set, expected a path without `..`", name);
  }
  std::error_code failure;
  const std::filesystem::path root = std::filesystem::canonical(folder, failure);
  if (failure) return fail("{}: cannot be read: {}", folder.string(), failure.message());
  const std::filesystem::path target = std::filesystem::canonical(root / relative, failure);
  if (failure) return fail("`{}` cannot be read: {}", name, failure.message());
  const auto [end_of_root, unused] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
  if (end_of_root != root.end())
    return fail("`{}` leads outside the set through a link, expected a file inside it", name);
  return target;
}

Result<tester::Curve> curve_from_csv(std::string_view text, const std::string& shown_name) {
  CsvLimits limits;
  limits.rows = kMostCurveRows + 1;
  CsvReader reader(text, shown_name, limits);
  CsvRow row;
  if (!reader.next(row)) return fail("{}: is empty, expected a heading `strain,stress_pa` and numbers", shown_name);
  const Result<CurveColumns> columns = find_columns(row, shown_name);
  if (!columns) return tl::unexpected(columns.error());
  tester::Curve curve;
  while (reader.next(row)) {
    if (row.blank()) continue;
    if (!row.fault.empty()) return fail("{}:{}:{}: {}", shown_name, row.fault_line, row.fault_column, row.fault);
    const Result<double> strain = number_at(row, columns->strain, "strain", shown_name);
    if (!strain) return tl::unexpected(strain.error());
    if (*strain <= -1.0) {
      return fail("{}:{}: column strain: {} is not a nominal strain, expected above -1", shown_name, row.line, *strain);
    }
    const Result<double> stress = number_at(row, columns->stress, "stress_pa", shown_name);
    if (!stress) return tl::unexpected(stress.error());
    const bool is_usual = kStrain.hold(*strain) && kStressPa.hold(*stress);
    if (!is_usual) {
      return fail("{}:{}: {} Pa at strain {}, expected at most {} Pa and a strain of at most {}", shown_name, row.line,
                  *stress, *strain, kStressPa.most, kStrain.most);
    }
    curve.strain.push_back(*strain);
    curve.stress_pa.push_back(*stress);
  }
  if (curve.size() < kFewestCurveRows) {
    return fail("{}: has {} rows, expected at least {}", shown_name, curve.size(), kFewestCurveRows);
  }
  return curve;
}

Result<tester::Curve> read_curve(const std::filesystem::path& path, const std::string& shown_name) {
  try {
    return curve_from_csv(read_file_up_to(path, kMostCurveBytes), shown_name);
  } catch (const InputError& error) {
    return fail("{}", error.what());
  }
}

std::string to_csv(const tester::Curve& curve) {
  std::string text = "strain,stress_pa\n";
  for (std::size_t i = 0; i < curve.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{}\n", curve.strain[i], curve.stress_pa[i]);
  }
  return text;
}

}  // namespace nacre::measurement
