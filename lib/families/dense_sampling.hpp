#pragma once
// Variants of a family around its seeds (thesis 2.4.1), by an ask interface: the caller evaluates them.

#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "base/random.hpp"
#include "pattern/layout.hpp"
#include "thesis/constants.hpp"

namespace nacre::families {

struct DenseSamplingSettings {
  int radius_pixels = thesis::kFamilyRadius;      ///< of 400, to the nearest seed
  int batch = 10;                                 ///< new patterns in an iteration
  int attempts = thesis::kDenseSamplingAttempts;  ///< mutations in an iteration; when they do not give a batch, the
                                                  ///< family is exhausted
  std::uint64_t seed = 1;
};

/// Smallest number of differing pixels to any of the seeds, and which one it is.
struct NearestSeed {
  std::size_t seed = 0;
  int difference = 0;
};
NearestSeed nearest_seed(const pattern::Pattern& pattern, std::span<const pattern::Pattern> seeds);

/// Mutates members of the family, drawn at random, one attempt at a time: an attempt that violates a constraint, leaves
/// the radius or gives a known pattern is rolled back. Deterministic in its settings.
class DenseSampler {
 public:
  /// The seeds may violate constraints (they were measured); their variants do not. Throws InputError without seeds.
  DenseSampler(std::vector<pattern::Pattern> seeds, const DenseSamplingSettings& settings);
  /// The next new patterns; fewer than a batch, and then none, once the family is exhausted.
  std::vector<pattern::Pattern> next();
  bool exhausted() const { return exhausted_; }
  /// Seeds first, then in the order of finding.
  const std::vector<pattern::Pattern>& members() const { return members_; }

 private:
  std::size_t seed_count_;
  DenseSamplingSettings settings_;
  RandomStream random_;
  std::vector<pattern::Pattern> members_;
  std::unordered_set<std::uint64_t> known_;
  bool exhausted_ = false;
};

}  // namespace nacre::families
