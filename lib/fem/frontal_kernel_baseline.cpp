// The frontal kernel for the baseline of x86-64.
#define NACRE_SIMD baseline
#include "fem/frontal_kernel.ipp"
