#pragma once
// The proposed patterns of a game, round by round, and all its specimens.

#include "report/exhibit.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

Exhibit proposal_exhibit(const run::RunRecord& run);
Exhibit specimen_exhibit(const run::RunRecord& run);

}  // namespace nacre::report
