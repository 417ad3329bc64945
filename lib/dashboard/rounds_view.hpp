#pragma once
// The game by rounds, as JSON.

#include <map>

#include "dashboard/json_parts.hpp"
#include "store/run_record.hpp"

namespace nacre::dashboard {

/// Per round: summary, errors, model, size of the gamut, proposals, measured front; and every measured pattern.
Json rounds_json(const store::RunRecord& run, const std::map<int, int>& gamut_sizes);

}  // namespace nacre::dashboard
