#pragma once

#include <string>
#include <vector>

#include "base/result.hpp"
#include "measurement/import.hpp"
#include "measurement/specimen_sheet.hpp"

namespace nacre::measurement {

/// What the rows of a piece have alike: what the sheet and the record say of it, and in `sample` its name.
ImportedSpecimen common_of_piece(const SheetRow& row, const TesterRecord& from);

/// The rows of the piece NAME as specimens NAME-1, NAME-2, ... (padded with zeros, so that they sort), each with all
/// doubts: none counts before they are settled. Doubts are added to `warnings`. The fault: names that are too long.
tl::expected<std::vector<ImportedSpecimen>, ImportFault> rows_of_piece(const SheetRow& row,
                                                                       std::vector<ImportedSpecimen> rows,
                                                                       const std::vector<ImportDoubt>& doubts,
                                                                       const std::string& sheet,
                                                                       std::vector<std::string>& warnings);

}  // namespace nacre::measurement
