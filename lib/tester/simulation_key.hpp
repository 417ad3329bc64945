#pragma once
// The key of the simulator farm's cache.

#include <string>

#include "tester/simulation.hpp"

namespace nacre::tester {

/// Raised when a golden result changes, so that caches never mix results of different kernels.
inline constexpr int kKernelVersion = 8;

/// Content hash of a simulation as far as its result depends on it, kernel version included.
std::string simulation_key(const Simulation& simulation, TestKind kind);

}  // namespace nacre::tester
