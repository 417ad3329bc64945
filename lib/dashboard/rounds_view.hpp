#pragma once
// The game by rounds, as JSON.

#include <optional>

#include "dashboard/json_parts.hpp"
#include "dashboard/live_search.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// Per round: summary, errors, model, size of the gamut, proposals, measured front; and every measured pattern. A round
/// that is being searched has the size that its gamut has come to.
Json rounds_json(const run::RunRecord& run, const std::optional<LiveSearch::Progress>& search);

}  // namespace nacre::dashboard
