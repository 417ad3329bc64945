#pragma once

#include <string>

#include "tester/simulation.hpp"

namespace nacre::tester {

/// A sentence when the simulation is impossible (parameters that the test needs out of range, orientation neither 0
/// nor 90, rate or thickness not above 0); empty when it is possible.
std::string simulation_fault(const Simulation& simulation, TestKind kind);

}  // namespace nacre::tester
