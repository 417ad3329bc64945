#pragma once
// The diagnosis of a round, as JSON.

#include "dashboard/json_parts.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// Null where the round has none.
Json diagnosis_json(const run::RunRecord& run, int round);

}  // namespace nacre::dashboard
