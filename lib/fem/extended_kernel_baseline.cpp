// Part of ExtendedKernel (extended_state.hpp): the build for any x86-64 processor.
#define NACRE_SIMD baseline
#include "fem/extended_kernel.ipp"
