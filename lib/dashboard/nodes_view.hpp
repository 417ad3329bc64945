#pragma once
// The nodes of a run as they last reported, as JSON.

#include <vector>

#include "dashboard/desk.hpp"
#include "dashboard/json_parts.hpp"

namespace nacre::dashboard {

/// Nodes with state, progress, time left and counters. `is_over`: the run's last round is closed, so that a silent node
/// is no fault.
Json nodes_json(const std::vector<NodeReport>& nodes, bool is_over);

}  // namespace nacre::dashboard
