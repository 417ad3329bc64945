#pragma once
// The nodes of a golden game, to be fed again.

#include <filesystem>
#include <string>

#include "game/scenario.hpp"
#include "runtime/node_main.hpp"

namespace nacre::golden {

/// The node as its program makes it; its work writes below `scratch`.
runtime::NodeProgram make_node(const std::string& node, const game::Scenario& scenario,
                               const std::filesystem::path& scratch);

}  // namespace nacre::golden
