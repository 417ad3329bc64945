#pragma once
// A cheap stand-in for the testers: rugged, with a trade-off between the two properties, and depending on how pixels
// hang together as toughness does. It means nothing physically.

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

inline optimize::Performance synthetic_performance(const pattern::Pattern& pattern) {
  int equal_neighbours = 0, soft_diagonals = 0;
  for (int r = 0; r < pattern::kQuarter; ++r) {
    for (int c = 0; c < pattern::kQuarter; ++c) {
      equal_neighbours += pattern.rigid(r, c) && pattern.rigid(r, c + 1);
      soft_diagonals += !pattern.rigid(r, c) && !pattern.rigid(r + 1, c + 1);
    }
  }
  const double rigid = pattern.rigid_fraction();
  std::uint64_t scrambled = pattern.bits() * 0x9e3779b97f4a7c15ull;
  const double jitter = static_cast<double>(scrambled >> 40) / static_cast<double>(1 << 24);  // in [0, 1)
  const double modulus = rigid * rigid * (0.5 + equal_neighbours / 100.0);
  const double toughness = (1.0 - rigid) * (0.5 + soft_diagonals / 40.0) * (0.9 + 0.2 * jitter);
  return {modulus * 1e9, toughness * 1e6};
}

/// Runs a search to its end; `fails` says which simulations fail.
template <class Fails>
std::vector<std::vector<pattern::Pattern>> run(Search& search, Fails fails) {
  std::vector<std::vector<pattern::Pattern>> batches;
  while (true) {
    const std::vector<pattern::Pattern> batch = search.ask();
    if (batch.empty()) return batches;
    batches.push_back(batch);
    std::vector<std::optional<optimize::Performance>> performances;
    for (const pattern::Pattern& pattern : batch) {
      performances.push_back(fails(pattern) ? std::nullopt : std::optional(synthetic_performance(pattern)));
    }
    search.tell(performances);
  }
}

inline std::vector<std::vector<pattern::Pattern>> run(Search& search) {
  return run(search, [](const pattern::Pattern&) { return false; });
}

}  // namespace nacre::explore
