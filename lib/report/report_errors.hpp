#pragma once
// Prediction errors of a game, round by round, with those of the thesis (Table 3.5) and of predictions that know
// nothing of structure.

#include "report/exhibit.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

Exhibit error_exhibit(const run::RunRecord& run);

}  // namespace nacre::report
