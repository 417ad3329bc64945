#pragma once
// The square four-node element of side h with 2 x 2 Gauss points, in units of h: coordinates and displacements are
// divided by h, so that an element's stiffness matrix per unit thickness does not depend on its size. Local nodes a: 0
// bottom left, 1 bottom right, 2 top left, 3 top right; local degree of freedom 2 a + direction (0 x, 1 y).

#include <array>

#include <Eigen/Core>

#include "fem/grid.hpp"
#include "material/neo_hookean.hpp"

namespace nacre::fem {

inline constexpr int kElementNodes = 4;
inline constexpr int kGaussPoints = 4;
inline constexpr double kGaussWeight = 0.25;  ///< of each point, the element's area being 1

using ElementVector = Eigen::Matrix<double, 2 * kElementNodes, 1>;
using ElementMatrix = Eigen::Matrix<double, 2 * kElementNodes, 2 * kElementNodes>;

/// Gradients of the shape functions, dN_a/dx and dN_a/dy, at each Gauss point.
using ShapeGradients = Eigen::Matrix<double, 2, kElementNodes>;
const std::array<ShapeGradients, kGaussPoints>& shape_gradients();

/// H = F - I = sum_a u_a (grad N_a)^T at one Gauss point.
inline Eigen::Matrix2d displacement_gradient(const ElementVector& displacement, const ShapeGradients& gradients) {
  return Eigen::Map<const Eigen::Matrix<double, 2, kElementNodes>>(displacement.data()) * gradients.transpose();
}

/// Nodal forces, sum over Gauss points of P grad N_a; Pa per unit thickness and unit h. False when J <= 0 somewhere.
bool internal_force(const ElementVector& displacement, const material::Lame& lame, ElementVector& force);

/// Strain energy of the element, J/m^3 (its area being 1). J > 0 required.
double strain_energy(const ElementVector& displacement, const material::Lame& lame);

/// Stiffness at F = I for Lame parameters (1, 0) and (0, 1): the element's matrix is mu * shear + lambda * bulk.
struct UnitStiffness {
  ElementMatrix shear;
  ElementMatrix bulk;
};
const UnitStiffness& unit_stiffness();
/// The same of an element of `width` x `height` (in units of h; displacements too).
UnitStiffness rectangle_stiffness(double width, double height);

/// Lame parameters of every element (Eqs. 2.2, 2.3); both zero where the grid is empty.
std::vector<material::Lame> lame_of(const Grid& grid);

/// Nodes of element (row, column) in local order.
inline std::array<int, kElementNodes> element_nodes(const Grid& grid, int row, int column) {
  const int bottom_left = row * (grid.columns + 1) + column;
  const int top_left = bottom_left + grid.columns + 1;
  return {bottom_left, bottom_left + 1, top_left, top_left + 1};
}

}  // namespace nacre::fem
