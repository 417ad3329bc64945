// The kernel of the extended law for any x86-64 processor.
#define NACRE_SIMD baseline
#include "fem/extended_kernel.ipp"
