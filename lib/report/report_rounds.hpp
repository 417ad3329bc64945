#pragma once
// A game round by round: gamuts with fronts and measured points, hypervolumes and gap, stress-strain curves.

#include "report/exhibit.hpp"
#include "store/run_record.hpp"

namespace nacre::report {

Exhibit gamut_exhibit(const store::RunRecord& run);
Exhibit round_exhibit(const store::RunRecord& run);
Exhibit curve_exhibit(const store::RunRecord& run);

}  // namespace nacre::report
