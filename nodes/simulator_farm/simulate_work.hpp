#pragma once
// The farm's long work: one simulation, or its answer out of the cache.

#include <map>
#include <memory>
#include <string>

#include "runtime/node_core.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::simulator_farm {

/// Kind "simulate": spec and result are the payloads of a SIMULATE with one design and one test and of its SIMULATED. A
/// failed simulation is a result with its reason; a cache that cannot be used throws InputError.
std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache);

}  // namespace nacre::simulator_farm
