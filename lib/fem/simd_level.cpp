#include "fem/simd_level.hpp"

#include <cstdlib>

namespace nacre::fem {
namespace {

#if defined(__clang__) && __clang_major__ < 18
// clang knows neither the levels by name nor every feature of them (lzcnt, movbe, f16c): enough for instrumented
// builds.
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}
bool has_v4() {
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
}
#else
bool has_v3() { return __builtin_cpu_supports("x86-64-v3"); }
bool has_v4() { return __builtin_cpu_supports("x86-64-v4"); }
#endif

}  // namespace

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

bool has_simd_level(SimdLevel level) {
  switch (level) {
    case SimdLevel::baseline:
      return true;
    case SimdLevel::avx2:
      return has_v3();
    case SimdLevel::avx512:
      return has_v4();
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
