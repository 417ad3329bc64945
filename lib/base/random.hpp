#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace nacre {

/// A named stream of random numbers. Streams with different names are independent, so that adding a consumer never
/// changes what another one draws. The draws depend on (seed, name) alone: the distributions are written out here
/// because those of the standard library may differ between implementations.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1) with 53 random bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, count), count >= 1, without modulo bias.
  int index(int count);
  /// Standard normal (Box-Muller, both values used).
  double normal();

 private:
  std::mt19937_64 engine_;
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace nacre
