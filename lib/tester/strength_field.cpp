#include "tester/strength_field.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"

namespace nacre::tester {

bool is_strength_cv(double value) {
  return value == 0.0 || (value >= kSmallestStrengthCv && value <= kLargestStrengthCv);
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

void draw_strengths(fem::Grid& grid, int refinement, const Simulation& simulation, int specimen) {
  if (simulation.strength_cv == 0.0) return;
  const double variance = std::log1p(simulation.strength_cv * simulation.strength_cv), s = std::sqrt(variance);
  RandomStream random(0, fmt::format("strength of {}/{}/{}", simulation.design.name(),
                                     simulation.conditions.orientation_deg, specimen));
  multiply_strengths(grid, refinement, [&] { return std::exp(s * random.normal() - 0.5 * variance); });
}

}  // namespace nacre::tester
