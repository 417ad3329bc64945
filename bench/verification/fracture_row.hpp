#pragma once
// One fracture test in the tables of the verification studies, and their patterns.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"
#include "tester/toughness.hpp"

namespace nacre::verification {

inline const std::vector<std::string> kFractureColumns = {"toughness_pa", "peak_stress_pa", "failure_strain"};

/// The row of a fracture test; zeros, and a line on standard error, when it failed.
inline std::vector<double> fracture_row(const std::string& key, const Result<tester::ToughnessResult>& result) {
  if (result) return {result->toughness_pa, result->peak_stress_pa, result->failure_strain};
  std::fprintf(stderr, "%s: %s\n", key.c_str(), result.error().message.c_str());
  return {0.0, 0.0, 0.0};
}

/// The two published patterns and random ones, half of them over the strata of Table 3.2, half of 76 to 85 % rigid.
inline std::vector<pattern::Pattern> study_patterns(int count, std::uint64_t seed) {
  std::vector<pattern::Pattern> patterns = {pattern::Pattern(0x577fffe9fffdef), pattern::Pattern(0x3ffc9b4ad4d2d9)};
  RandomStream random(seed, "verification study");
  for (int i = 0; static_cast<int>(patterns.size()) < count; ++i)
    patterns.push_back(i % 2 == 0 ? pattern::stratified_patterns(4, random)[i / 2 % 4]
                                  : pattern::random_pattern(76 + (7 * i) % 10, random));
  patterns.resize(count);
  return patterns;
}

}  // namespace nacre::verification
