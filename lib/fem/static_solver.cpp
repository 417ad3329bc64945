#include "fem/static_solver.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fem/element.hpp"
#include "fem/frontal_cholesky.hpp"

namespace nacre::fem {
namespace {

constexpr double kTolerance = 1e-10;
/// Where a soft layer carries stiff ones, the rounding of displacements alone leaves a residual above kTolerance: below
/// this level the solution is also accepted when another correction no longer halves it.
constexpr double kRoundingLevel = 1e-8;
constexpr int kMaximumCorrections = 30;

/// Prescribed unknowns (2 per node): vertical ones in the grips, one sideways, and all of nodes that no element holds.
std::vector<char> held_unknowns(const Grid& grid) {
  const int nodes_per_row = grid.columns + 1;
  const int nodes = nodes_per_row * (grid.rows + 1);
  std::vector<char> held(static_cast<std::size_t>(2 * nodes), 1);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (grid.phase[static_cast<std::size_t>(grid.index(row, column))] != Phase::empty)
        for (const int node : element_nodes(grid, row, column))
          held[static_cast<std::size_t>(2 * node)] = held[static_cast<std::size_t>(2 * node + 1)] = 0;
  for (int node = 0; node < nodes; ++node)
    if (node < nodes_per_row || node >= nodes - nodes_per_row) held[static_cast<std::size_t>(2 * node + 1)] = 1;
  for (int node = 0; node < nodes; ++node)
    if (!held[static_cast<std::size_t>(2 * node)]) {
      held[static_cast<std::size_t>(2 * node)] = 1;  // the first that is free to move sideways
      break;
    }
  return held;
}

/// The factorisation that this thread used last: searches and calibrations solve one shape of grid thousands of times,
/// and planning and touching fresh memory would cost as much as the arithmetic.
FrontalCholesky& factorisation_for(const Grid& grid, const std::vector<char>& held) {
  struct Last {
    std::vector<char> held;
    int columns = 0;
    bool whole = false;
    std::unique_ptr<FrontalCholesky> factorisation;
  };
  thread_local Last last;
  const bool whole = std::find(grid.phase.begin(), grid.phase.end(), Phase::empty) == grid.phase.end();
  const bool same = last.factorisation && whole && last.whole && last.columns == grid.columns && last.held == held;
  if (!same)
    last = {.held = held,
            .columns = grid.columns,
            .whole = whole,
            .factorisation =
                std::make_unique<FrontalCholesky>(std::make_shared<const DissectionPlan>(dissect(grid, held)))};
  return *last.factorisation;
}

/// Forces of all elements on their nodes, 2 per node. False when an element is turned inside out.
bool nodal_forces(const Grid& grid, const std::vector<material::Lame>& lame, const std::vector<double>& displacement,
                  std::vector<double>& force) {
  force.assign(displacement.size(), 0.0);
  ElementVector local, local_force;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      if (grid.phase[e] == Phase::empty) continue;
      const auto nodes = element_nodes(grid, row, column);
      for (int a = 0; a < 8; ++a)
        local[a] = displacement[static_cast<std::size_t>(2 * nodes[static_cast<std::size_t>(a / 2)] + a % 2)];
      if (!internal_force(local, lame[e], local_force)) return false;
      for (int a = 0; a < 8; ++a)
        force[static_cast<std::size_t>(2 * nodes[static_cast<std::size_t>(a / 2)] + a % 2)] += local_force[a];
    }
  return true;
}

/// Sum of the vertical forces on a row of nodes over the number of columns: force / (width h) = Pa.
double row_stress(const Grid& grid, const std::vector<double>& force, int node_row) {
  double sum = 0.0;
  for (int column = 0; column <= grid.columns; ++column)
    sum += force[static_cast<std::size_t>(2 * (node_row * (grid.columns + 1) + column) + 1)];
  return sum / grid.columns;
}

/// Norm of the forces on free unknowns, and of the reactions.
struct Balance {
  double free = 0.0;
  double held = 0.0;
};

Balance balance_of(const std::vector<char>& held, const std::vector<double>& force) {
  double free_square = 0.0, held_square = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) (held[i] ? held_square : free_square) += force[i] * force[i];
  return {.free = std::sqrt(free_square), .held = std::sqrt(held_square)};
}

/// The linear profile: every row of nodes moves up in proportion to its height.
std::vector<double> stretched(const Grid& grid, double strain) {
  std::vector<double> displacement;
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column) displacement.insert(displacement.end(), {0.0, strain * row});
  return displacement;
}

/// Corrects the displacement until the forces balance; leaves the forces of the last state in `force`.
Result<void> balance(const Grid& grid, const std::vector<material::Lame>& lame, const std::vector<char>& held,
                     FrontalCholesky& stiffness, StaticSolution& solution, std::vector<double>& force) {
  std::vector<double> step;
  double previous = 1.0;
  for (;; ++solution.corrections) {
    if (!nodal_forces(grid, lame, solution.displacement, force))
      return fail("static solver: an element is turned inside out");
    const Balance forces = balance_of(held, force);
    solution.relative_residual = forces.held > 0.0 ? forces.free / forces.held : forces.free;
    if (solution.relative_residual < kTolerance) return {};
    if (solution.relative_residual < kRoundingLevel && solution.relative_residual > 0.5 * previous) return {};
    previous = solution.relative_residual;
    if (!std::isfinite(solution.relative_residual) || solution.corrections == kMaximumCorrections)
      return fail("static solver: relative residual {} after {} corrections", solution.relative_residual,
                  solution.corrections);
    step = force;
    stiffness.solve(step);
    for (std::size_t i = 0; i < step.size(); ++i)
      if (!held[i]) solution.displacement[i] -= step[i];
  }
}

}  // namespace

Result<StaticSolution> pull(const Grid& grid, double strain) {
  if (!(std::abs(strain) <= 0.5)) return fail("static solver: strain {} is outside -0.5 to 0.5", strain);
  const std::vector<material::Lame> lame = lame_of(grid);
  const std::vector<char> held = held_unknowns(grid);
  FrontalCholesky& stiffness = factorisation_for(grid, held);
  if (!stiffness.factorise(lame)) return fail("static solver: a part of the grid is held by nothing");

  StaticSolution solution;
  solution.displacement = stretched(grid, strain);
  std::vector<double> force;
  if (const Result<void> done = balance(grid, lame, held, stiffness, solution, force); !done)
    return tl::unexpected(done.error());
  solution.top_stress_pa = row_stress(grid, force, grid.rows);
  solution.bottom_stress_pa = -row_stress(grid, force, 0);
  return solution;
}

}  // namespace nacre::fem
