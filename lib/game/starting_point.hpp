#pragma once
// What a game begins with, from the files that its scenario names.

#include "game/scenario.hpp"
#include "material/parameters.hpp"
#include "material/ranges.hpp"

namespace nacre::game {

/// Where parameters are looked for: `ranges_file`, or the thesis' ranges. Throws InputError.
material::ParameterRanges ranges_of(const Scenario& scenario);

/// The model before anything was fitted: `model_file` over the built-in parameters, brought inside the ranges. Throws
/// InputError.
material::ParameterSet starting_model(const Scenario& scenario);

}  // namespace nacre::game
