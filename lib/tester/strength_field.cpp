#include "tester/strength_field.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "material/extensions.hpp"

namespace nacre::tester {

bool specimens_differ(const material::ParameterSet& parameters) {
  return parameters.strength_cv > 0.0 || material::extension_value(parameters.extensions, "strength_scatter") > 0.0;
}

void multiply_strengths(fem::Grid& grid, int refinement, const std::function<double()>& draw_factor) {
  const int columns = grid.columns / refinement, rows = grid.rows / refinement;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double factor = draw_factor();
      for (int part = 0; part < refinement * refinement; ++part) {
        const int fine_row = row * refinement + part / refinement,
                  fine_column = column * refinement + part % refinement;
        grid.threshold_j_per_m3[grid.index(fine_row, fine_column)] *= factor;
      }
    }
}

void draw_strengths(fem::Grid& grid, int refinement, const Simulation& simulation) {
  const double cv = simulation.parameters.strength_cv;
  if (cv == 0.0) return;
  const double variance = std::log1p(cv * cv), s = std::sqrt(variance);
  RandomStream random(0, fmt::format("strength of {}/{}/{}", simulation.design.name(),
                                     simulation.conditions.orientation_deg, simulation.specimen));
  multiply_strengths(grid, refinement, [&] { return std::exp(s * random.normal() - 0.5 * variance); });
}

}  // namespace nacre::tester
