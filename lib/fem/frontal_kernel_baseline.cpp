// Part of FrontalKernel (frontal_kernel.hpp): the build for any x86-64 processor.
#define NACRE_SIMD baseline
#include "fem/frontal_kernel.ipp"
