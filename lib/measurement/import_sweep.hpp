#pragma once
// A frequency sweep of a homogeneous specimen -> measured moduli, one of each line of its table.

#include <string>
#include <vector>

#include "base/result.hpp"
#include "measurement/import.hpp"
#include "measurement/specimen_sheet.hpp"

namespace nacre::measurement {

/// The specimens NAME-1, NAME-2, ... (padded with zeros, so that they sort) of the piece NAME: modulus E', strain rate
/// angular frequency times strain amplitude, column `temperature_c` where the table tells it. The amplitude is the
/// table's, else the sheet's. `from` holds a sweep; `sheet` is for messages. Doubts are added to `warnings`. The fault
/// names the sheet's line: another test than `modulus`, a layout, no amplitude.
tl::expected<std::vector<ImportedSpecimen>, ImportFault> import_sweep(const SheetRow& row, const TesterRecord& from,
                                                                      const std::string& sheet,
                                                                      std::vector<std::string>& warnings);

}  // namespace nacre::measurement
