#pragma once
// Measured limits of the core, to which a kernel's speed is compared.

#include <cstddef>
#include <string>
#include <vector>

#include "fem/simd_level.hpp"

namespace nacre::bench {

/// Bandwidth of one thread that reads an array that fits into a level of the memory, or adds a number to all of it in
/// place (counted twice: read and written), bytes/s.
struct Bandwidth {
  std::string level;
  std::size_t bytes;  ///< of the array
  double read_per_s, update_per_s;
};

/// Single precision, one thread, vectors as wide as the instruction set has them.
struct MachineLimits {
  double clock_hz;                ///< from a chain of additions of one cycle each
  double fused_per_s;             ///< fused multiply-adds alone, 2 operations each
  double multiply_and_add_per_s;  ///< as many multiplications as additions, 1 operation each
  double divisions_per_s;
  std::vector<Bandwidth> memory;  ///< L1, L2, L3, DRAM
};

MachineLimits measure_limits(fem::SimdLevel level);

/// The kind of core, from /proc/cpuinfo.
std::string core_name();

}  // namespace nacre::bench
