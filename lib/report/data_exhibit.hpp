#pragma once
// What a measurement set shows by itself, before any model.

#include "diagnosis/data_summary.hpp"
#include "report/exhibit.hpp"

namespace nacre::report {

/// Whether there is anything to show: homogeneous specimens, or a condition that varies.
bool shows_data(const diagnosis::DataSummary& data);

/// Modulus against strain rate (logarithms, one ink a material), means of homogeneous specimens, changes with every
/// condition.
Exhibit data_exhibit(const diagnosis::DataSummary& data);

}  // namespace nacre::report
