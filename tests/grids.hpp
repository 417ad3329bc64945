#pragma once
// Grids for the tests of the solvers.

#include "base/random.hpp"
#include "fem/grid.hpp"

namespace nacre::fem {

struct Uniform {
  double young_pa = 1e9, poisson = 0.3, threshold_j_per_m3 = 1e300;
};

/// Every element rigid and of one material, h = 260 um.
inline Grid uniform_grid(int columns, int rows, const Uniform& material = {}) {
  const auto count = static_cast<std::size_t>(columns * rows);
  return {.columns = columns,
          .rows = rows,
          .element_size_m = 260e-6,
          .phase = std::vector<Phase>(count, Phase::rigid),
          .young_pa = std::vector<double>(count, material.young_pa),
          .poisson = std::vector<double>(count, material.poisson),
          .threshold_j_per_m3 = std::vector<double>(count, material.threshold_j_per_m3)};
}

/// Elements between 1 MPa and 3 GPa at random.
inline Grid random_grid(int columns, int rows) {
  Grid grid = uniform_grid(columns, rows);
  RandomStream random(1, "random_grid");
  for (std::size_t e = 0; e < grid.young_pa.size(); ++e) {
    grid.young_pa[e] = random.uniform() < 0.5 ? 1e6 : 3e9;
    grid.poisson[e] = random.uniform(0.0, 0.5);
  }
  return grid;
}

}  // namespace nacre::fem
