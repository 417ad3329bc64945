#include "laboratory/modulus_bench.hpp"

#include <array>
#include <cmath>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace nacre::laboratory {
namespace {

using ElementMatrix = Eigen::Matrix<double, 8, 8>;

/// Stiffness of a square element per unit of mu and of lambda (any edge length: the two-dimensional form has no scale).
/// Nodes (0,0), (1,0), (0,1), (1,1); unknown 2 n + axis. 2 x 2 Gauss points.
struct UnitStiffness {
  ElementMatrix per_mu = ElementMatrix::Zero();
  ElementMatrix per_lambda = ElementMatrix::Zero();
};

UnitStiffness unit_stiffness() {
  UnitStiffness stiffness;
  const double offset = 0.5 / std::sqrt(3.0);
  for (const double x : {0.5 - offset, 0.5 + offset}) {
    for (const double y : {0.5 - offset, 0.5 + offset}) {
      const std::array<double, 4> by_x = {-(1 - y), 1 - y, -y, y}, by_y = {-(1 - x), -x, 1 - x, x};
      Eigen::Matrix<double, 4, 8> gradient = Eigen::Matrix<double, 4, 8>::Zero();  // u_x,x  u_x,y  u_y,x  u_y,y
      for (int n = 0; n < 4; ++n) {
        const auto i = static_cast<std::size_t>(n);
        gradient(0, 2 * n) = gradient(2, 2 * n + 1) = by_x[i];
        gradient(1, 2 * n) = gradient(3, 2 * n + 1) = by_y[i];
      }
      const auto shear = (gradient.row(1) + gradient.row(2)).eval();
      const auto dilatation = (gradient.row(0) + gradient.row(3)).eval();
      // sigma : epsilon = 2 mu (e_xx^2 + e_yy^2) + mu gamma^2 + lambda tr^2, a quarter of the area each point.
      stiffness.per_mu +=
          0.25 *
          (2.0 * (gradient.row(0).transpose() * gradient.row(0) + gradient.row(3).transpose() * gradient.row(3)) +
           shear.transpose() * shear);
      stiffness.per_lambda += 0.25 * dilatation.transpose() * dilatation;
    }
  }
  return stiffness;
}

/// Numbers the unknowns: vertical displacements of the grip rows and one horizontal one are prescribed.
struct Unknowns {
  int columns = 0, rows = 0;
  std::vector<int> number;  ///< per (node, axis); -1 where prescribed
  int count = 0;

  Unknowns(int columns_, int rows_) : columns(columns_), rows(rows_) {
    number.assign(static_cast<std::size_t>(2 * (columns + 1) * (rows + 1)), -1);
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column <= columns; ++column) {
        const auto at = static_cast<std::size_t>(2 * node(row, column));
        const bool grip = row == 0 || row == rows;
        if (!(row == 0 && column == columns / 2)) number[at] = count++;
        if (!grip) number[at + 1] = count++;
      }
    }
  }
  int node(int row, int column) const { return row * (columns + 1) + column; }
  /// The eight unknowns of an element (row, column), -1 where prescribed.
  std::array<int, 8> of_element(int row, int column) const {
    std::array<int, 8> result{};
    const std::array<int, 4> nodes = {node(row, column), node(row, column + 1), node(row + 1, column),
                                      node(row + 1, column + 1)};
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        result[2 * n + axis] = number[static_cast<std::size_t>(2 * nodes[n]) + axis];
      }
    }
    return result;
  }
};

/// Displacement of an element's unknowns where the top grip has moved by one element edge, tilted about its middle, and
/// all else is at rest.
Eigen::Matrix<double, 8, 1> grip_displacement(const Raster& raster, int row, int column) {
  Eigen::Matrix<double, 8, 1> displacement = Eigen::Matrix<double, 8, 1>::Zero();
  if (row != raster.rows - 1) return displacement;
  const auto moved = [&](int node) {
    return 1.0 + raster.grips.tilt * (static_cast<double>(node) / raster.columns - 0.5);
  };
  displacement(5) = moved(column);
  displacement(7) = moved(column + 1);
  return displacement;
}

/// Element stiffness of a raster.
class Elements {
 public:
  explicit Elements(const Raster& raster) : raster_(raster) {}
  ElementMatrix stiffness(int row, int column) const {
    const auto e = static_cast<std::size_t>(row * raster_.columns + column);
    return raster_.mu_pa[e] * unit_.per_mu + raster_.lambda_pa[e] * unit_.per_lambda;
  }

 private:
  const Raster& raster_;
  UnitStiffness unit_ = unit_stiffness();
};

/// Lower triangle of the stiffness matrix of the free unknowns, and the load that the moved grip puts on them.
struct Equations {
  Eigen::SparseMatrix<double> matrix;
  Eigen::VectorXd load;
};

Equations equations(const Raster& raster, const Elements& elements, const Unknowns& unknowns) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(raster.columns * raster.rows) * 36);
  Equations result{.matrix = Eigen::SparseMatrix<double>(unknowns.count, unknowns.count),
                   .load = Eigen::VectorXd::Zero(unknowns.count)};
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      const ElementMatrix stiffness = elements.stiffness(row, column);
      const std::array<int, 8> number = unknowns.of_element(row, column);
      const Eigen::Matrix<double, 8, 1> reaction = stiffness * grip_displacement(raster, row, column);
      for (std::size_t i = 0; i < 8; ++i) {
        if (number[i] < 0) continue;
        result.load(number[i]) -= reaction(static_cast<int>(i));
        for (std::size_t j = 0; j < 8; ++j) {
          if (number[j] < 0 || number[j] > number[i]) continue;
          entries.emplace_back(number[i], number[j], stiffness(static_cast<int>(i), static_cast<int>(j)));
        }
      }
    }
  }
  if (raster.grips.side_stiffness_pa > 0.0)
    for (const int row : {0, raster.rows})
      for (int column = 0; column <= raster.columns; ++column) {
        const int sideways = unknowns.number[2 * unknowns.node(row, column)];
        if (sideways >= 0) entries.emplace_back(sideways, sideways, raster.grips.side_stiffness_pa);
      }
  result.matrix.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Force on the bottom grip per unit of thickness, in Pa times element edges.
double bottom_force(const Raster& raster, const Elements& elements, const Unknowns& unknowns,
                    const Eigen::VectorXd& solution) {
  double force = 0.0;
  for (int column = 0; column < raster.columns; ++column) {
    Eigen::Matrix<double, 8, 1> displacement = grip_displacement(raster, 0, column);
    const std::array<int, 8> number = unknowns.of_element(0, column);
    for (std::size_t i = 0; i < 8; ++i) {
      if (number[i] >= 0) displacement(static_cast<int>(i)) = solution(number[i]);
    }
    const Eigen::Matrix<double, 8, 1> forces = elements.stiffness(0, column) * displacement;
    force -= forces(1) + forces(3);
  }
  return force;
}

}  // namespace

Result<double> pull_elastically(const Raster& raster) {
  const Elements elements(raster);
  const Unknowns unknowns(raster.columns, raster.rows);
  const Equations system = equations(raster, elements, unknowns);
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky(system.matrix);
  if (cholesky.info() != Eigen::Success) return fail("modulus bench: the stiffness matrix is not positive definite");
  const double force = bottom_force(raster, elements, unknowns, cholesky.solve(system.load));
  // Stress force / columns over strain 1 / rows, both in element edges.
  const double modulus_pa = force / raster.columns * raster.rows;
  if (!std::isfinite(modulus_pa) || modulus_pa <= 0.0) return fail("modulus bench: modulus {} Pa", modulus_pa);
  return modulus_pa;
}

}  // namespace nacre::laboratory
