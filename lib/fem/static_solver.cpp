#include "fem/static_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>

#include "fem/element.hpp"
#include "fem/explicit_storage.hpp"
#include "fem/extended_storage.hpp"
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
  std::vector<char> held(2 * nodes, 1);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (grid.phase[grid.index(row, column)] != Phase::empty)
        for (const int node : element_nodes(grid, row, column)) held[2 * node] = held[2 * node + 1] = 0;
  for (int node = 0; node < nodes; ++node)
    if (node < nodes_per_row || node >= nodes - nodes_per_row) held[2 * node + 1] = 1;
  for (int node = 0; node < nodes; ++node)
    if (!held[2 * node]) {
      held[2 * node] = 1;  // the first that is free to move sideways
      break;
    }
  return held;
}

/// The last workspace of this thread: searches and calibrations solve one shape of grid thousands of times, and
/// planning and touching fresh memory would cost as much as the arithmetic.
struct Workspace {
  std::vector<char> held;
  int columns = 0, rows = 0;
  bool whole = false;
  std::unique_ptr<FrontalCholesky> factorisation;
  std::unique_ptr<ExplicitStorage<double>> storage;
};

Workspace& workspace_for(const Grid& grid, std::vector<char> held) {
  thread_local Workspace last;
  const bool whole = std::find(grid.phase.begin(), grid.phase.end(), Phase::empty) == grid.phase.end();
  const bool same = last.factorisation && whole && last.whole && last.columns == grid.columns && last.held == held;
  if (!same) {
    auto plan = std::make_shared<const DissectionPlan>(dissect(grid, held));
    last = {.held = std::move(held),
            .columns = grid.columns,
            .rows = grid.rows,
            .whole = whole,
            .factorisation = std::make_unique<FrontalCholesky>(std::move(plan)),
            .storage = std::make_unique<ExplicitStorage<double>>(grid.columns, grid.rows, false)};
  }
  return last;
}

/// The grid at rest on the linear profile (every row of nodes moves up in proportion to its height), from which the
/// displacements of the explicit kernel are counted. Its forces are then in Pa, per element size and unit thickness.
ExtendedState<double> stretched(const Grid& grid, const std::vector<material::Lame>& lame, double strain,
                                const ExplicitStorage<double>& storage) {
  ExtendedState<double> state;
  static_cast<ExplicitState<double>&>(state) = storage.state();
  const auto nodes = static_cast<std::size_t>((grid.rows + 1) * state.stride);
  std::fill_n(state.qx, nodes, 0.0);
  std::fill_n(state.qy, nodes, 0.0);
  std::fill_n(state.threshold, static_cast<std::size_t>(grid.rows * state.element_stride),
              std::numeric_limits<double>::infinity());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const material::Lame& constants = lame[grid.index(row, column)];
      state.mu[row * state.element_stride + column] = kGaussWeight * constants.mu_pa;
      state.lambda[row * state.element_stride + column] = kGaussWeight * constants.lambda_pa;
    }
  state.strain = strain;
  return state;
}

/// Calls visit(unknown, place in the state's arrays, direction) for every unknown.
template <class Visit>
void for_every_unknown(const Grid& grid, int stride, const Visit& visit) {
  std::size_t unknown = 0;
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column)
      for (int direction = 0; direction < 2; ++direction) visit(unknown++, row * stride + column, direction);
}

/// Forces on all unknowns in their order.
void forces_of(const Grid& grid, const ExplicitState<double>& state, std::vector<double>& force) {
  for_every_unknown(grid, state.stride, [&](std::size_t unknown, int at, int direction) {
    force[unknown] = direction == 0 ? state.vx[at] : state.vy[at];
  });
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

void internal_forces(ExtendedState<double>& state) {
  if (state.eigenstrain == nullptr && state.inverse_limit == nullptr) {
    explicit_kernel<double>(best_simd_level()).internal_forces(state);
  } else {
    extended_kernel<double>(best_simd_level()).internal_forces(state);
  }
}

/// Corrects the displacement until the forces balance against the reactions, or against `least_reactions` where these
/// are smaller; leaves the reactions of the last state in `state`.
Result<void> balance(const Grid& grid, Workspace& workspace, ExtendedState<double>& state, StaticSolution& solution,
                     double least_reactions = 0.0) {
  const ExplicitKernel<double>& kernel = explicit_kernel<double>(best_simd_level());
  const std::vector<char>& held = workspace.held;
  std::vector<double> force(held.size());
  double previous = 1.0;
  for (;; ++solution.corrections) {
    if (kernel.first_inverted(state) >= 0) return fail("static solver: an element is inverted (J <= 0)");
    internal_forces(state);
    forces_of(grid, state, force);
    Balance forces = balance_of(held, force);
    forces.held = std::max(forces.held, least_reactions);
    solution.relative_residual = forces.held > 0.0 ? forces.free / forces.held : forces.free;
    if (solution.relative_residual < kTolerance) return {};
    if (solution.relative_residual < kRoundingLevel && solution.relative_residual > 0.5 * previous) return {};
    previous = solution.relative_residual;
    if (!std::isfinite(solution.relative_residual) || solution.corrections == kMaximumCorrections)
      return fail("static solver: relative residual {} after {} corrections", solution.relative_residual,
                  solution.corrections);
    workspace.factorisation->solve(force);
    for_every_unknown(grid, state.stride, [&](std::size_t unknown, int at, int direction) {
      if (!held[unknown]) (direction == 0 ? state.qx : state.qy)[at] += force[unknown];
    });
  }
}

/// Displacements in the laboratory frame.
std::vector<double> displacements(const Grid& grid, const ExplicitState<double>& state) {
  std::vector<double> result(2 * (grid.columns + 1) * (grid.rows + 1));
  for_every_unknown(grid, state.stride, [&](std::size_t unknown, int at, int direction) {
    result[unknown] = direction == 0 ? state.qx[at] : state.qy[at] + state.strain * (at / state.stride);
  });
  return result;
}

/// The grid with those of its laws that have no history.
Grid elastic(const Grid& grid) {
  Grid result = grid;
  result.laws = {.eigenstrain = grid.laws.eigenstrain, .inverse_limit = grid.laws.inverse_limit, .yield_pa = {}};
  return result;
}

/// The order of the reactions to eigenstrains that cannot relax.
double eigen_reactions(const Grid& grid) {
  double largest = 0.0, compliance = 0.0;
  int standing = 0;
  for (std::size_t e = 0; e < grid.phase.size(); ++e) {
    if (grid.phase[e] == Phase::empty) continue;
    largest = std::max(largest, std::abs(grid.laws.eigenstrain[e]));
    compliance += 1.0 / grid.young_pa[e];
    ++standing;
  }
  return largest * standing / compliance * std::sqrt(static_cast<double>(grid.columns));
}

constexpr int kMostRestSteps = 10;
constexpr double kRestTolerance = 1e-7;

/// Moves the grips until they carry no force (secant); the state is balanced there. Returns the strain.
Result<double> come_to_rest(const Grid& grid, Workspace& workspace, ExtendedState<double>& state) {
  const double reactions = eigen_reactions(grid);
  const auto force_at = [&](double strain) -> Result<double> {
    state.strain = strain;
    StaticSolution solution;
    const Result<void> done = balance(grid, workspace, state, solution, reactions);
    if (!done) return tl::unexpected(done.error());
    return state.top_force;
  };
  double last_strain = 0.0, strain = 0.0;
  for (const double eigenstrain : grid.laws.eigenstrain) strain += eigenstrain / grid.element_count();
  Result<double> last = force_at(last_strain);
  if (!last || *last == 0.0 || strain == 0.0) return last.transform([](double) { return 0.0; });
  const double first = std::abs(*last);
  for (int i = 0; i < kMostRestSteps; ++i) {
    const Result<double> now = force_at(strain);
    if (!now) return now;
    if (std::abs(*now) <= kRestTolerance * first || *now == *last) return strain;
    const double next = strain - *now * (strain - last_strain) / (*now - *last);
    last_strain = strain;
    last = now;
    strain = next;
  }
  return fail("static solver: no equilibrium under the eigenstrains");
}

}  // namespace

Result<StaticSolution> pull(const Grid& grid, double strain) {
  if (!(std::abs(strain) <= 0.5)) return fail("static solver: strain {} is outside -0.5 to 0.5", strain);
  const std::vector<material::Lame> lame = lame_of(grid);
  Workspace& workspace = workspace_for(grid, held_unknowns(grid));
  if (!workspace.factorisation->factorise(lame)) return fail("static solver: a part of the grid is not supported");

  StaticSolution solution;
  ExtendedState<double> state = stretched(grid, lame, strain, *workspace.storage);
  if (const Result<void> done = balance(grid, workspace, state, solution); !done) return tl::unexpected(done.error());
  solution.displacement = displacements(grid, state);
  solution.top_stress_pa = state.top_force / grid.columns;
  solution.bottom_stress_pa = state.bottom_force / grid.columns;
  return solution;
}

Result<RestingSolution> pull_from_rest(const Grid& whole, double strain) {
  const Grid grid = elastic(whole);
  assert(!grid.laws.eigenstrain.empty());
  const std::vector<material::Lame> lame = lame_of(grid);
  Workspace& workspace = workspace_for(grid, held_unknowns(grid));
  if (!workspace.factorisation->factorise(lame)) return fail("static solver: a part of the grid is not supported");
  ExtendedState<double> state = stretched(grid, lame, 0.0, *workspace.storage);
  const ExtendedStorage<double> laws(grid, kGaussWeight, 0.0, state);
  const Result<double> rest = come_to_rest(grid, workspace, state);
  if (!rest) return tl::unexpected(rest.error());
  RestingSolution result{.rest_strain = *rest, .displacement = displacements(grid, state), .stress_pa = 0.0};
  const double resting_force = state.top_force;
  state.strain += strain * (1.0 + *rest);
  StaticSolution solution;
  if (const Result<void> done = balance(grid, workspace, state, solution, eigen_reactions(grid)); !done)
    return tl::unexpected(done.error());
  result.stress_pa = (state.top_force - resting_force) / grid.columns;
  return result;
}

}  // namespace nacre::fem
