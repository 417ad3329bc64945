#pragma once
// The farm's long work: one simulation, or its answer out of the cache.

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "runtime/node_core.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::simulator_farm {

/// Kind "simulate": the spec is the payload of a SIMULATE with one design and one test, the result an Answer
/// (question.hpp). Films are written into the folder `films`, as SIMULATION_KEY.film; one that is there already is not
/// made again. A failed simulation is a result with its reason; a cache or a folder that cannot be used throws
/// InputError.
std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache,
                                                            std::filesystem::path films);

}  // namespace nacre::simulator_farm
