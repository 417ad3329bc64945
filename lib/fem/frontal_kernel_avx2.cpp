// Part of FrontalKernel (frontal_kernel.hpp): the build for x86-64-v3 (AVX2).
#define NACRE_SIMD avx2
#include "fem/frontal_kernel.ipp"
