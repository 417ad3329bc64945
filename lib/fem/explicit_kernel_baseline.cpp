// Part of ExplicitKernel (explicit_state.hpp): the build for any x86-64 processor.
#define NACRE_SIMD baseline
#include "fem/explicit_tables.ipp"
