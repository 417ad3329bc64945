#include "fem/static_solver.hpp"

#include <cmath>

#include <Eigen/SparseCholesky>

#include "fem/element.hpp"

namespace nacre::fem {
namespace {

using Vector = Eigen::VectorXd;
using Factor = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;

constexpr int kHeld = -1;
constexpr double kTolerance = 1e-11;
constexpr int kMaximumCorrections = 30;

/// Equation number of each degree of freedom (2 node + direction), kHeld where the displacement is prescribed.
struct Equations {
  std::vector<int> number;
  int count = 0;
};

Equations number_equations(const Grid& grid) {
  const int nodes_per_row = grid.columns + 1;
  const int nodes = nodes_per_row * (grid.rows + 1);
  std::vector<char> carried(static_cast<std::size_t>(nodes), 0);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (grid.phase[static_cast<std::size_t>(grid.index(row, column))] != Phase::empty)
        for (const int node : element_nodes(grid, row, column)) carried[static_cast<std::size_t>(node)] = 1;
  Equations equations;
  equations.number.assign(static_cast<std::size_t>(2 * nodes), kHeld);
  bool sideways_held = false;
  for (int node = 0; node < nodes; ++node) {
    if (!carried[static_cast<std::size_t>(node)]) continue;
    const bool gripped = node < nodes_per_row || node >= nodes - nodes_per_row;
    if (sideways_held) equations.number[static_cast<std::size_t>(2 * node)] = equations.count++;
    sideways_held = true;  // the first node stands on the bottom grip
    if (!gripped) equations.number[static_cast<std::size_t>(2 * node + 1)] = equations.count++;
  }
  return equations;
}

Eigen::SparseMatrix<double> tangent_matrix(const Grid& grid, const std::vector<material::Lame>& lame,
                                           const Equations& equations) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(grid.element_count()) * 36);
  const UnitStiffness& unit = unit_stiffness();
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      if (grid.phase[e] == Phase::empty) continue;
      const ElementMatrix stiffness = lame[e].mu_pa * unit.shear + lame[e].lambda_pa * unit.bulk;
      const auto nodes = element_nodes(grid, row, column);
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b) {
          const int i = equations.number[static_cast<std::size_t>(2 * nodes[static_cast<std::size_t>(a / 2)] + a % 2)];
          const int j = equations.number[static_cast<std::size_t>(2 * nodes[static_cast<std::size_t>(b / 2)] + b % 2)];
          if (i != kHeld && j != kHeld && i >= j) entries.emplace_back(i, j, stiffness(a, b));
        }
    }
  Eigen::SparseMatrix<double> matrix(equations.count, equations.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
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

/// Norm of the free nodes' forces, and of the reactions.
struct Balance {
  double free = 0.0;
  double held = 0.0;
};

Balance balance_of(const Equations& equations, const std::vector<double>& force, Vector& residual) {
  double held = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (equations.number[i] == kHeld)
      held += force[i] * force[i];
    else
      residual[equations.number[i]] = -force[i];
  }
  return {.free = residual.norm(), .held = std::sqrt(held)};
}

}  // namespace

Result<StaticSolution> pull(const Grid& grid, double strain) {
  if (!(std::abs(strain) <= 0.5)) return fail("static solver: strain {} is outside -0.5 to 0.5", strain);
  const Equations equations = number_equations(grid);
  const std::vector<material::Lame> lame = lame_of(grid);
  const Factor factor(tangent_matrix(grid, lame, equations));
  if (factor.info() != Eigen::Success) return fail("static solver: a part of the grid is held by nothing");

  StaticSolution solution;
  solution.displacement.assign(equations.number.size(), 0.0);
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column)
      solution.displacement[static_cast<std::size_t>(2 * (row * (grid.columns + 1) + column) + 1)] = strain * row;

  std::vector<double> force;
  Vector residual(equations.count);
  for (;; ++solution.corrections) {
    if (!nodal_forces(grid, lame, solution.displacement, force))
      return fail("static solver: an element is turned inside out");
    const Balance balance = balance_of(equations, force, residual);
    solution.relative_residual = balance.held > 0.0 ? balance.free / balance.held : balance.free;
    if (solution.relative_residual < kTolerance) break;
    if (!std::isfinite(solution.relative_residual) || solution.corrections == kMaximumCorrections)
      return fail("static solver: relative residual {} after {} corrections", solution.relative_residual,
                  solution.corrections);
    const Vector step = factor.solve(residual);
    for (std::size_t i = 0; i < equations.number.size(); ++i)
      if (equations.number[i] != kHeld) solution.displacement[i] += step[equations.number[i]];
  }
  solution.top_stress_pa = row_stress(grid, force, grid.rows);
  solution.bottom_stress_pa = -row_stress(grid, force, 0);
  return solution;
}

}  // namespace nacre::fem
