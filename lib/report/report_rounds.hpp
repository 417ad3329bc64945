#pragma once
// A game round by round: gamuts with fronts and measured points, hypervolumes and gap, stress-strain curves.

#include "report/exhibit.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

Exhibit gamut_exhibit(const run::RunRecord& run);
Exhibit round_exhibit(const run::RunRecord& run);
Exhibit curve_exhibit(const run::RunRecord& run);

}  // namespace nacre::report
