// The explicit kernel for any x86-64 processor.
#define NACRE_SIMD baseline
#include "fem/explicit_tables.ipp"
