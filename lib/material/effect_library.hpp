#pragma once
// The table of effects: names, units, ranges, the tests in which each acts, and a sentence about it.

#include "material/extensions.hpp"

namespace nacre::material {

/// All effects that the model can be extended by, in a fixed order.
std::span<const Effect> effect_library();

/// Laws of the conditions of tests (Effect::law_of): how specimens of one material differ between two machines or with
/// temperature. They stand in for free levels of their condition, and never reach the testers: the one of temperature
/// changes the rate at which a specimen is simulated (temperature_shift.hpp), those of humidity and age its stiffness
/// (surroundings_laws.hpp), those of machines what is recorded.
std::span<const Effect> condition_laws();

}  // namespace nacre::material
