#pragma once
// Static equilibrium of a grid between two grips, double precision.

#include <vector>

#include "base/result.hpp"
#include "fem/grid.hpp"

namespace nacre::fem {

/// A grid in equilibrium. Stresses are nominal: total vertical reaction over the width, unit thickness.
struct StaticSolution {
  double top_stress_pa = 0.0;
  double bottom_stress_pa = 0.0;     ///< equal to the top's up to the residual
  std::vector<double> displacement;  ///< 2 per node (x, y), in units of the element size; nodes as in grid.hpp
  int corrections = 0;               ///< solutions with the tangent at F = I
  double relative_residual = 0.0;    ///< norm of the free nodes' forces over the norm of the grip's reactions
};

/// Pulls the grid to a nominal `strain` (-0.5 to 0.5): the top row of nodes moves up by strain x height, the bottom row
/// stays, both are free to move sideways but for one node. Modified Newton on the finite-strain forces with the sparse
/// Cholesky factor of the tangent at F = I, until the relative residual is below 1e-10 or rounding (at most 1e-8) stops
/// it. Error: an inverted element, no convergence (expected beyond strains of some per cent), a part of the grid
/// that is not supported.
Result<StaticSolution> pull(const Grid& grid, double strain);

/// A grid whose elements hold eigenstrains, between grips that first let it rest and then pull it.
struct RestingSolution {
  double rest_strain = 0.0;          ///< of the grips where they carry no force in sum
  std::vector<double> displacement;  ///< there, as in StaticSolution
  double stress_pa = 0.0;            ///< gained by the pull from there
};

/// Lets the grid come to rest, then pulls it by `strain` of the height that it then has. Errors as pull().
Result<RestingSolution> pull_from_rest(const Grid& grid, double strain);

}  // namespace nacre::fem
