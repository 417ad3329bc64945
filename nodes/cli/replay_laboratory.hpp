#pragma once

#include "game/scenario.hpp"
#include "runtime/node_main.hpp"

namespace nacre::cli {

/// The virtual laboratory of a scenario, for replay and to see whether its file can be read: the only place besides
/// `nacre measure` that knows its truth.
runtime::NodeProgram make_laboratory(const game::Scenario& scenario);

}  // namespace nacre::cli
