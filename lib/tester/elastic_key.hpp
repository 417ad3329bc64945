#pragma once
// Which modulus tests of layouts have one solution: twins that differ in what the model does not know, and effects that
// do not act on the constants of an element.

#include <string>

#include "tester/simulation.hpp"

namespace nacre::tester {

/// Key of the static solution of a layout on elements of 1/refinement: simulation_key() but for what it does not depend
/// on. Tests with one key differ in rate_factor() alone.
std::string elastic_key(Simulation simulation, int refinement = 1);

}  // namespace nacre::tester
