// Part of ExtendedKernel (extended_state.hpp): the build for x86-64-v3 (AVX2 and FMA).
#define NACRE_SIMD avx2
#include "fem/extended_kernel.ipp"
