#pragma once
// The additive low-discrepancy sequence x_n = x_0 + n (1/g, 1/g^2, ...) mod 1.

#include <cstdint>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// An endless low-discrepancy sequence in the unit cube: multiples of the powers of 1/g, where g is the root of
/// g^(d+1) = g + 1 (the golden ratio for d = 1), modulo 1, from a random origin.
class SpaceFillingPoints {
 public:
  SpaceFillingPoints(int dimension, std::uint64_t seed);
  Point next();

 private:
  Point stride_, position_;
};

}  // namespace nacre::optimize
