#pragma once
// Patterns for tests that need many.

#include <vector>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::pattern {

inline std::vector<Pattern> random_patterns(int count, std::uint64_t seed) {
  RandomStream random(seed, "test");
  std::vector<Pattern> patterns;
  for (int i = 0; i < count; ++i) patterns.push_back(random_pattern(random));
  return patterns;
}

}  // namespace nacre::pattern
