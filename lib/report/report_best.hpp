#pragma once
// The best designs of a game against homogeneous mixtures of equal stiffness (thesis, Table 3.3).

#include <string>

#include "report/exhibit.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

/// The design with the largest gain, as HTML for the head of a page; empty before a pattern was measured in both tests.
std::string best_design(const run::RunRecord& run);

/// The measured front, each design with its gain.
Exhibit best_exhibit(const run::RunRecord& run);

}  // namespace nacre::report
