#pragma once

#include <nlohmann/json.hpp>

#include "nacre/node_status_t.hpp"

namespace nacre::wire {

/// Appends a node's counters, queues, work and last problem to `node`, each under the name that the message gives it.
void append_counters(nlohmann::ordered_json& node, const node_status_t& status);

}  // namespace nacre::wire
