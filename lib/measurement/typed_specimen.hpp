#pragma once
// One specimen typed into a form instead of read from a set.

#include <map>
#include <string>
#include <string_view>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// The specimen of one row of a measurement set: `fields` by the names of its columns (docs/FORMATS.md), missing ones
/// empty; `curve_csv`: its curve as the text of a curve file, empty for none. Patterns are keys or homogeneous
/// materials, never files. The same rules as for a set; the error names column and what was expected.
tl::expected<SpecimenRecord, RejectedRow> specimen_from_fields(const std::map<std::string, std::string>& fields,
                                                               std::string_view curve_csv);

/// The specimen with other values in some columns (all but `specimen` and `curve`), checked in the same way; its curve
/// stays.
tl::expected<SpecimenRecord, RejectedRow> with_changes(const SpecimenRecord& specimen,
                                                       const std::map<std::string, std::string>& changes);

}  // namespace nacre::measurement
