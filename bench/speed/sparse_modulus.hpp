#pragma once

#include "fem/grid.hpp"

namespace nacre::bench {

/// Young's modulus of a grid at vanishing strain, Pa, the way a textbook does it: triplets, a sparse matrix, Eigen's
/// SimplicialLLT with its own ordering. The yardstick for the modulus tester's speed.
double sparse_modulus_pa(const fem::Grid& grid);

}  // namespace nacre::bench
