#pragma once
// The farm's long work: one simulation, or its result out of the cache.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/node_core.hpp"
#include "simulator_farm/test_request.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::simulator_farm {

/// The test request in the spec of a Compute of the kind "simulate". Throws std::logic_error when it is none.
struct AskedSimulation {
  tester::Simulation simulation;
  tester::TestKind test = tester::TestKind::modulus;
  std::string key;  ///< simulation_key
  Extras extras;
};
AskedSimulation asked_in(const std::string& spec);

/// Whether the cache holds all that is asked for except the film.
bool has_numbers(const store::SimulationCache& cache, const AskedSimulation& asked);

/// Whether simulate_work() takes all from cache and film folder, without a simulation.
bool is_known(const store::SimulationCache& cache, const std::filesystem::path& films, const AskedSimulation& asked);

/// Keeps what a test gave, whoever ran it. The first result under a key stays. Breaks (nullptr: they are not kept) are
/// kept with the numbers of their own fracture alone: whoever comes later, and rounds otherwise, keeps them only where
/// the numbers agree to 1 %. Returns whether the result was new.
bool keep_response(store::SimulationCache& cache, const std::string& key, const store::CachedSimulation& response,
                   const std::vector<tester::Break>* breaks);

/// Simulates what the cache does not know yet of a spec, keeps it there, and writes the TestResponse (test_request.hpp)
/// from what is kept. Numbers, crack and film tell of one fracture: a film that shows another is not kept, and its name
/// is empty; numbers whose crack cannot be told become a failure that says so.
std::string simulate_work(store::SimulationCache& cache, const std::filesystem::path& films, const std::string& spec);

/// Kind "simulate": the spec is the payload of a SIMULATE with one design and one test, the result a TestResponse
/// (test_request.hpp). Films are written into the folder `films`, as SIMULATION_KEY.film; one that is there already is
/// not made again. A failed simulation is a result with its reason; a cache or a folder that cannot be used throws
/// InputError.
std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache,
                                                            std::filesystem::path films);

}  // namespace nacre::simulator_farm
