#pragma once

#include <string_view>

namespace nacre::fem {

/// Instruction sets the kernels are compiled for. All give the same bits; they differ in speed alone.
enum class SimdLevel { baseline, avx2, avx512 };
std::string_view to_string(SimdLevel level);

/// The widest level this processor has; the environment variable NACRE_SIMD = baseline | avx2 | avx512 forces a lower
/// one.
SimdLevel best_simd_level();

/// Whether this processor can run `level`.
bool has_simd_level(SimdLevel level);

}  // namespace nacre::fem
