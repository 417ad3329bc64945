#pragma once
// The game by rounds, as JSON.

#include "dashboard/json_parts.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// Per round: summary, errors, model, size of the gamut, proposals, measured front; and every measured pattern.
Json rounds_json(const run::RunRecord& run);

}  // namespace nacre::dashboard
