#pragma once
// The laboratory's work, as JSON.

#include "dashboard/desk.hpp"
#include "dashboard/json_parts.hpp"

namespace nacre::dashboard {

/// The newest proposal, designs with their state, orders, specimens, groups of replicates with proposed outliers.
Json laboratory_json(const Laboratory& laboratory);

}  // namespace nacre::dashboard
