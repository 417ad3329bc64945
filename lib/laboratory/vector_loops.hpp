#pragma once
// How the laboratory's inner loops become vector code with either compiler.

#ifdef __clang__
#define NACRE_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define NACRE_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif

/// One function per instruction set, chosen when the program starts.
#define NACRE_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
