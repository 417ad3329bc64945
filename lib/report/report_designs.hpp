#pragma once
// The proposed patterns of a game, round by round, and all its specimens.

#include "report/exhibit.hpp"
#include "store/run_record.hpp"

namespace nacre::report {

Exhibit proposal_exhibit(const store::RunRecord& run);
Exhibit specimen_exhibit(const store::RunRecord& run);

}  // namespace nacre::report
