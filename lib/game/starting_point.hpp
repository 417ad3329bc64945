#pragma once
// The initial state of a game, from the files that its scenario names.

#include "game/scenario.hpp"
#include "material/parameters.hpp"
#include "material/ranges.hpp"

namespace nacre::game {

/// Ranges of the fitted parameters: `ranges_file`, or those of the thesis. Throws InputError.
material::ParameterRanges ranges_of(const Scenario& scenario);

/// The model before anything was fitted: `model_file` over the built-in parameters, brought inside the ranges. Throws
/// InputError.
material::ParameterSet starting_model(const Scenario& scenario);

}  // namespace nacre::game
