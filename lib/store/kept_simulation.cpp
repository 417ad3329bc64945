#include "store/kept_simulation.hpp"

#include "tester/simulation_key.hpp"

namespace nacre::store {
namespace {

CachedSimulation failed(const Error& error) {
  CachedSimulation cached;
  cached.failure = error.message;
  return cached;
}

/// Looks up or simulates; `test` is tester::test_modulus or tester::test_toughness.
template <class Test>
CachedSimulation looked_up(SimulationCache* cache, const tester::Simulation& simulation, tester::TestKind kind,
                           const Test& test) {
  if (cache == nullptr) return kept(test(simulation, tester::Discretisation{}));
  const std::string key = tester::simulation_key(simulation, kind);
  if (auto known = cache->find(key)) return *std::move(known);
  const CachedSimulation cached = kept(test(simulation, tester::Discretisation{}));
  cache->insert(key, cached);
  return cached;
}

}  // namespace

CachedSimulation kept(const Result<tester::ModulusResult>& result) {
  if (!result) return failed(result.error());
  CachedSimulation cached;
  cached.modulus_pa = result->modulus_pa;
  return cached;
}

CachedSimulation kept(const Result<tester::ToughnessResult>& result) {
  if (!result) return failed(result.error());
  CachedSimulation cached;
  cached.toughness_pa = result->toughness_pa;
  cached.peak_stress_pa = result->peak_stress_pa;
  cached.failure_strain = result->failure_strain;
  cached.curve = tester::resampled(result->curve, kKeptCurvePoints);
  return cached;
}

std::optional<optimize::Performance> kept_performance(const tester::Simulation& simulation, SimulationCache* cache) {
  const CachedSimulation modulus = looked_up(cache, simulation, tester::TestKind::modulus, tester::test_modulus);
  if (!modulus.failure.empty()) return std::nullopt;
  const CachedSimulation toughness = looked_up(cache, simulation, tester::TestKind::toughness, tester::test_toughness);
  if (!toughness.failure.empty()) return std::nullopt;
  return optimize::Performance{modulus.modulus_pa, toughness.toughness_pa};
}

}  // namespace nacre::store
