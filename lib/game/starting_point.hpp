#pragma once
// The initial state of a game, from the files that its scenario names.

#include "game/scenario.hpp"
#include "material/starting_model.hpp"

namespace nacre::game {

/// The model before anything was fitted, and the ranges of the fits: `model_file` and `ranges_file`. Throws InputError.
material::StartingModel starting_model(const Scenario& scenario);

}  // namespace nacre::game
