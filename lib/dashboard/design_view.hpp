#pragma once
// One design, as JSON.

#include "dashboard/json_parts.hpp"
#include "pattern/design.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// All that a run knows of one design: proposals, specimens with curves, simulations, cracks.
Json design_json(const run::RunRecord& run, const pattern::Design& design);

}  // namespace nacre::dashboard
