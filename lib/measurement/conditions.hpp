#pragma once
// When two specimens were tested under the same nominal conditions, though measured rate and thickness differ slightly.

#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// Tolerances of rate and thickness, relative to the ordered ones.
inline constexpr double kRateTolerance = 0.25, kThicknessTolerance = 0.1;

/// Same orientation, rate and thickness within their tolerances of `ordered`.
bool same_conditions(const tester::TestConditions& tested, const tester::TestConditions& ordered);

/// Whether a test is the standard one of its design, upright or turned.
bool is_standard(const tester::TestConditions& tested);

/// The specimens under nominal conditions: the standard ones where same_conditions() holds, otherwise those of the
/// first specimen (by name) of the same kind, so that replicates of 3.17 and 3.24 mm are in one group. The order is
/// kept.
std::vector<SpecimenRecord> at_nominal_conditions(std::vector<SpecimenRecord> specimens);

}  // namespace nacre::measurement
