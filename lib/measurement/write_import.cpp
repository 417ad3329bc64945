#include "measurement/write_import.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "measurement/provenance.hpp"
#include "measurement/read_set.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_table.hpp"
#include "measurement/write_set.hpp"

namespace nacre::measurement {
namespace {

/// Whether the set's specimen is the one that was imported. Validity, notes and columns that the import does not know
/// are ignored.
bool same_test(SpecimenRecord known, const SpecimenRecord& imported) {
  for (const auto& [name, text] : imported.other_columns) {
    const auto cell = known.other_columns.find(name);
    if ((cell == known.other_columns.end() ? "" : cell->second) != text) return false;
  }
  known.other_columns = imported.other_columns;
  known.valid = imported.valid;
  known.note = imported.note;
  return known == imported;
}

/// Sorts `import` by what the set already holds; returns the specimens that are new to it.
std::vector<SpecimenRecord> settle(const std::filesystem::path& folder, const std::string& sheet, Import& import,
                                   bool replace) {
  const MeasurementSet set = read_measurement_set(folder);
  const SetTable table(folder);
  std::vector<SpecimenRecord> added;
  std::vector<ImportedSpecimen> kept;
  for (ImportedSpecimen& one : import.specimens) {
    const auto known = std::find_if(set.specimens.begin(), set.specimens.end(),
                                    [&](const auto& each) { return each.specimen == one.record.specimen; });
    const bool repeated = known != set.specimens.end() && same_test(*known, one.record);
    const bool replaces = !repeated && table.holds(one.record.specimen);
    if (replaces && !replace) {
      import.rejected.push_back(
          {sheet, one.line, "specimen",
           fmt::format("`{}` is already in {} with other content, which is kept; expected another name, "
                       "or --replace",
                       one.record.specimen, (folder / kTableName).string())});
      continue;
    }
    import.known += repeated;
    import.replaced += replaces;
    if (const std::string doubt = doubt_of_twins(one.record, set.specimens); !repeated && !doubt.empty())
      import.warnings.push_back(doubt);
    if (known != set.specimens.end()) {
      one.record.valid = known->valid;
      one.record.note = known->note;
    }
    if (!repeated) added.push_back(one.record);
    kept.push_back(std::move(one));
  }
  import.specimens = std::move(kept);
  return added;
}

}  // namespace

void write_import(const std::filesystem::path& folder, const std::string& sheet, Import& import, bool replace) {
  std::error_code unreadable;
  if (std::filesystem::exists(folder / kTableName, unreadable)) {
    const std::vector<SpecimenRecord> added = settle(folder, sheet, import, replace);
    if (!added.empty()) add_to_measurement_set(folder, added);
    if (!import.specimens.empty()) write_provenance(folder, import.specimens);
    return;
  }
  std::vector<SpecimenRecord> records;
  for (const ImportedSpecimen& one : import.specimens) records.push_back(one.record);
  if (records.empty()) return;
  write_measurement_set(folder, records);
  write_provenance(folder, import.specimens);
}

}  // namespace nacre::measurement
