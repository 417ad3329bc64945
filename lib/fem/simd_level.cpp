#include "fem/simd_level.hpp"

#include <cstdlib>

namespace nacre::fem {

std::string_view to_string(SimdLevel level) {
  switch (level) {
    case SimdLevel::baseline:
      return "baseline";
    case SimdLevel::avx2:
      return "avx2";
    case SimdLevel::avx512:
      return "avx512";
  }
  return "unknown";
}

// By features, since Clang before 18 does not know the levels x86-64-v3 and -v4 by name.
bool has_simd_level(SimdLevel level) {
  switch (level) {
    case SimdLevel::baseline:
      return true;
    case SimdLevel::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
             __builtin_cpu_supports("bmi2");
    case SimdLevel::avx512:
      return has_simd_level(SimdLevel::avx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
  }
  return false;
}

SimdLevel best_simd_level() {
  static const SimdLevel level = [] {
    const char* forced = std::getenv("NACRE_SIMD");
    for (const SimdLevel candidate : {SimdLevel::avx512, SimdLevel::avx2}) {
      const bool excluded = forced && (forced == to_string(SimdLevel::baseline) ||
                                       (forced == to_string(SimdLevel::avx2) && candidate == SimdLevel::avx512));
      if (!excluded && has_simd_level(candidate)) return candidate;
    }
    return SimdLevel::baseline;
  }();
  return level;
}

}  // namespace nacre::fem
