#pragma once
// Stress relaxation of a homogeneous specimen -> relaxation moduli at a handful of times, as rows of one piece.

#include <string>
#include <vector>

#include "base/result.hpp"
#include "measurement/import.hpp"
#include "measurement/specimen_sheet.hpp"

namespace nacre::measurement {

/// Whether a record of extension and force is one of relaxation: a modulus test of a homogeneous material with a clock,
/// whose strain is held to its end; or the sheet names the strain, and the record has no other.
bool is_held(const SheetRow& row, const TesterRecord& from);

/// The specimens NAME-1, NAME-2, ... of the piece NAME, of a table by time or a record that is_held(): modulus_pa is
/// stress over strain, `hold_s` the time after the middle of the ramp, from a whole ramp after its end on, thinned();
/// the strain rate is rate_of_hold(). A table may hold one strain after another, and temperatures. The fault names what
/// was expected: the test `modulus`, a homogeneous material, a strain, units.
tl::expected<std::vector<ImportedSpecimen>, ImportFault> import_relaxation(const SheetRow& row,
                                                                           const TesterRecord& from,
                                                                           const std::string& sheet,
                                                                           std::vector<std::string>& warnings);

}  // namespace nacre::measurement
