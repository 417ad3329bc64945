#include "measurement/typed_specimen.hpp"

#include <algorithm>

#include "measurement/set_files.hpp"
#include "measurement/set_row.hpp"
#include "measurement/specimen_checks.hpp"

namespace nacre::measurement {
namespace {

constexpr const char* kCurveName = "curve";
/// Enough for anything typed by hand.
constexpr std::size_t kLongestField = 2000;

RejectedRow rejected(std::string column, std::string reason) { return {1, std::move(column), std::move(reason)}; }

}  // namespace

tl::expected<SpecimenRecord, RejectedRow> specimen_from_fields(const std::map<std::string, std::string>& fields,
                                                               std::string_view curve_csv) {
  SetHeading heading;
  heading.position.fill(kAbsent);
  CsvRow row;
  row.line = 1;
  for (const auto& [name, text] : fields) {
    const auto known = std::find(kColumns.begin(), kColumns.end(), name);
    if (known == kColumns.end() || name == kColumns[kCurve]) return tl::unexpected(rejected(name, "no such column"));
    if (text.size() > kLongestField)
      return tl::unexpected(rejected(name, fmt::format("is longer than {} bytes", kLongestField)));
    heading.position[known - kColumns.begin()] = row.cells.size();
    row.cells.push_back({text, 1, 0});  // no place in a file
  }
  // The row parser would read a file of that name.
  if (const auto pattern = fields.find(std::string(kColumns[kPattern]));
      pattern != fields.end() && !pattern->second.empty()) {
    const auto design = pattern::design_from_word(trimmed(pattern->second));
    if (!design) return tl::unexpected(rejected(pattern->first, design.error().message));
  }
  heading.position[kCurve] = row.cells.size();
  row.cells.push_back({curve_csv.empty() ? "" : kCurveName, 1, 1});
  heading.cell_count = row.cells.size();
  auto record =
      parse_row({}, heading, row, false, [&](const std::string& name) { return curve_from_csv(curve_csv, name); });
  if (!record || !record->valid) return record;
  if (const auto implausible = implausible_value(*record)) return tl::unexpected(*implausible);
  return record;
}

tl::expected<SpecimenRecord, RejectedRow> with_changes(const SpecimenRecord& specimen,
                                                       const std::map<std::string, std::string>& changes) {
  SpecimenRecord plain = specimen;
  plain.other_columns.clear();
  std::map<std::string, std::string> fields = cells_of(plain, "");
  fields.erase(std::string(kColumns[kCurve]));
  for (const auto& [name, text] : changes) {
    if (name == kColumns[kSpecimen]) return tl::unexpected(rejected(name, "stays, expected other columns"));
    fields[name] = text;
  }
  return specimen_from_fields(fields, specimen.curve.empty() ? "" : to_csv(specimen.curve));
}

}  // namespace nacre::measurement
