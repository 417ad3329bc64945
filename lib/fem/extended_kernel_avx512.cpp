// Part of ExtendedKernel (extended_state.hpp): the build for x86-64-v4 (AVX-512).
#define NACRE_SIMD avx512
#include "fem/extended_kernel.ipp"
