#pragma once
// Sobol's low-discrepancy sequence.

#include <array>
#include <cstdint>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// Sobol's sequence in up to sixteen dimensions (primitive polynomials and direction numbers of S. Joe and F. Y. Kuo,
/// SIAM J. Sci. Comput. 30, 2635 (2008)), moved by a digital shift that the seed draws, so that no point lies on a face
/// of the cube and every 2^k consecutive points from a multiple of 2^k on still fall one into each of 2^k equal slices
/// of every axis.
class SobolPoints {
 public:
  static constexpr int kMostDimensions = 16;
  /// Throws InputError for dimensions outside 1..16.
  SobolPoints(int dimension, std::uint64_t seed);
  Point next();

 private:
  static constexpr int kBits = 32;
  std::vector<std::array<std::uint32_t, kBits>> directions_;
  std::vector<std::uint32_t> state_, shift_;
  std::uint32_t count_ = 0;
};

}  // namespace nacre::optimize
