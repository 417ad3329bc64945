#pragma once

#include "measurement/plausibility.hpp"
#include "measurement/specimen_sheet.hpp"

namespace nacre::measurement {

/// Stress over strain as recorded, strain from that of the first row on, by the sizes of the sheet; factors of
/// extension and of force where their units are assumed.
tester::Curve nominal_curve(const TesterRecord& record, const SheetRow& row, const AssumedUnits& units);

}  // namespace nacre::measurement
