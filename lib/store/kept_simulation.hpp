#pragma once
// The testers behind the cache: what was simulated once is looked up.

#include "optimize/pareto.hpp"
#include "store/simulation_cache.hpp"
#include "tester/modulus.hpp"
#include "tester/toughness.hpp"

namespace nacre::store {

/// Points that a curve is resampled to before it is kept.
inline constexpr int kKeptCurvePoints = 256;

/// What is kept of a tester's result.
CachedSimulation kept(const Result<tester::ModulusResult>& result);
CachedSimulation kept(const Result<tester::ToughnessResult>& result);

/// Both properties of a design, from the cache or, where they are not known, simulated and kept (nullptr: simulated);
/// nothing when one of the tests has no result. Thread-safe. Throws InputError when the cache cannot be written.
std::optional<optimize::Performance> kept_performance(const tester::Simulation& simulation, SimulationCache* cache);

}  // namespace nacre::store
