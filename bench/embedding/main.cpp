// How long the map of a subfamily takes: N patterns around two seeds, their earth mover's distances and their Isomap
// (docs/studies/families.md).

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <span>

#include "families/dense_sampling.hpp"
#include "families/isomap.hpp"

namespace {

using namespace nacre;

struct Stopwatch {
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::clock_t processor = std::clock();  // all threads
  void say(const char* what) const {
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double processor_s = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
    fmt::print("{}: {:.1f} s, {:.1f} s of processors\n", what, wall_s, processor_s);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? static_cast<std::size_t>(std::atoi(argv[1])) : 3000;
  // Both published patterns: around one of them there are only some 2000.
  families::DenseSampler sampler({pattern::Pattern(0x577fffe9fffdef), pattern::Pattern(0x3ffc9b4ad4d2d9)}, {.seed = 1});
  while (sampler.members().size() < count && !sampler.exhausted()) sampler.next();
  const auto patterns = std::span(sampler.members()).first(std::min(count, sampler.members().size()));
  fmt::print("{} patterns within 16 pixels of two seeds\n", patterns.size());
  const Stopwatch whole, distances_watch;
  const families::DistanceMatrix distances = families::earth_movers_distances(patterns);
  distances_watch.say("earth mover's distances");
  const Stopwatch isomap_watch;
  const families::Embedding map = families::isomap(distances);
  isomap_watch.say("Isomap");
  whole.say("map");
  fmt::print("residual variance {:.4f}, {} bridges\n", map.residual_variance, map.bridges);
}
