#pragma once
// A periodic medium that is symmetric about both axes, pulled along one of them: the cell between two neighbouring
// mirror lines of either direction is enough.

#include <span>
#include <vector>

#include "base/result.hpp"
#include "material/neo_hookean.hpp"

namespace nacre::fem {

/// The cell in equilibrium at small strain, pulled along y, free to contract along x.
struct PulledCell {
  double modulus_pa = 0.0;              ///< stress over strain
  std::vector<double> energy_j_per_m3;  ///< mean over each element, at a strain of 1; the energy grows with its square
};

/// `sizes`: lengths of the n columns and of the n rows of elements, in any unit. `lame`: n x n, row 0 at the bottom.
/// Four-node elements, tangent at F = I, double precision. The sides stay straight, as mirror lines do. Error: a soft
/// mode (a part without stiffness).
Result<PulledCell> pull_cell(std::span<const double> sizes, const std::vector<material::Lame>& lame);

}  // namespace nacre::fem
