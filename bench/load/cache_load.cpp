#include <fmt/format.h>

#include "base/hash.hpp"
#include "latencies.hpp"
#include "loads.hpp"
#include "made_up.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::load {
namespace {

std::string key_of(int i) { return content_hash(fmt::format("simulation {}", i)); }

}  // namespace

void load_cache(const Options& options) {
  const std::filesystem::path file = options.folder / "simulations.db";
  RandomStream random(options.seed, "load/cache");
  Latencies inserting, opening, finding, missing;
  {
    store::SimulationCache cache(file);
    for (int i = 0; i < options.simulations; ++i) {
      store::CachedSimulation result;
      result.toughness_pa = 1e6 * random.uniform();
      constexpr int kCurvePoints = 128;
      result.curve = made_up_curve(kCurvePoints, random);
      inserting.time([&] { cache.insert(key_of(i), result); });
      if ((i + 1) % 10'000 == 0)
        fmt::print("{} of {} results written\n", i + 1, options.simulations), std::fflush(stdout);
    }
  }
  inserting.print("cache: write a result");
  std::unique_ptr<store::SimulationCache> cache;
  opening.time([&] { cache = std::make_unique<store::SimulationCache>(file); });
  opening.print("cache: open, every page checked");
  constexpr int kLookups = 10'000;
  for (int i = 0; i < kLookups; ++i) {
    const std::string known = key_of(random.index(options.simulations)), unknown = key_of(options.simulations + i);
    finding.time([&] { cache->find(known); });
    missing.time([&] { cache->find(unknown); });
  }
  finding.print("cache: look up what is known");
  missing.print("cache: look up what is not known");
  fmt::print("cache: {} results, file {:.0f} MB, memory {}\n", cache->size(),
             static_cast<double>(std::filesystem::file_size(file)) / 1e6, peak_memory());
}

}  // namespace nacre::load
