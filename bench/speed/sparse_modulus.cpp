#include "sparse_modulus.hpp"

#include <stdexcept>
#include <vector>

#include <Eigen/Sparse>

#include "fem/element.hpp"

namespace nacre::bench {
namespace {

/// Number of each unknown in the system; -1 prescribed: vertical ones of both grips, one horizontal.
std::vector<int> numbered_unknowns(const fem::Grid& grid, int& count) {
  const int per_row = grid.columns + 1, nodes = per_row * (grid.rows + 1);
  std::vector<int> number(static_cast<std::size_t>(2 * nodes), -1);
  count = 0;
  for (int node = 0; node < nodes; ++node) {
    if (node > 0) number[2 * node] = count++;
    if (node >= per_row && node < nodes - per_row) number[2 * node + 1] = count++;
  }
  return number;
}

}  // namespace

double sparse_modulus_pa(const fem::Grid& grid) {
  int count = 0;
  const std::vector<int> number = numbered_unknowns(grid, count);
  const std::vector<material::Lame> lame = fem::lame_of(grid);
  std::vector<Eigen::Triplet<double>> triplets;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(count);
  const auto prescribed = [&](int unknown) {  // strain 1
    return unknown % 2 == 1 ? static_cast<double>(unknown / 2 / (grid.columns + 1)) : 0.0;
  };
  const auto visit = [&](const auto& use) {
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const material::Lame& constants = lame[grid.index(row, column)];
        const fem::ElementMatrix stiffness =
            constants.mu_pa * fem::unit_stiffness().shear + constants.lambda_pa * fem::unit_stiffness().bulk;
        const auto nodes = fem::element_nodes(grid, row, column);
        for (int a = 0; a < 8; ++a)
          for (int b = 0; b < 8; ++b) use(2 * nodes[a / 2] + a % 2, 2 * nodes[b / 2] + b % 2, stiffness(a, b));
      }
  };
  visit([&](int a, int b, double k) {
    const int i = number[a], j = number[b];
    if (i < 0) return;
    if (j >= 0)
      triplets.emplace_back(i, j, k);
    else
      load[i] -= k * prescribed(b);
  });
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the stiffness matrix is not positive definite");
  const Eigen::VectorXd solution = factor.solve(load);
  const int top = 2 * grid.rows * (grid.columns + 1);
  double force = 0.0;
  visit([&](int a, int b, double k) {
    if (a < top || a % 2 == 0) return;
    const int j = number[b];
    force += k * (j >= 0 ? solution[j] : prescribed(b));
  });
  return force / grid.columns;
}

}  // namespace nacre::bench
