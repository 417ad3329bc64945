#include "fem/element.hpp"

#include <cmath>

namespace nacre::fem {
namespace {

std::array<ShapeGradients, kGaussPoints> make_gradients() {
  const double near = 0.5 - 0.5 / std::sqrt(3.0), far = 0.5 + 0.5 / std::sqrt(3.0);
  std::array<ShapeGradients, kGaussPoints> result;
  for (int point = 0; point < kGaussPoints; ++point) {
    const double x = point % 2 == 0 ? near : far, y = point < 2 ? near : far;
    // N = (1-x)(1-y), x(1-y), (1-x)y, xy.
    result[static_cast<std::size_t>(point)] << -(1 - y), 1 - y, -y, y, -(1 - x), -x, 1 - x, x;
  }
  return result;
}

ElementMatrix make_stiffness(const material::Lame& lame) {
  const Eigen::Matrix4d moduli = material::tangent(Eigen::Matrix2d::Zero(), lame);
  ElementMatrix stiffness = ElementMatrix::Zero();
  for (const ShapeGradients& gradients : shape_gradients()) {
    Eigen::Matrix<double, 4, 2 * kElementNodes> operator_b = Eigen::Matrix<double, 4, 2 * kElementNodes>::Zero();
    for (int node = 0; node < kElementNodes; ++node)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) operator_b(2 * i + j, 2 * node + i) = gradients(j, node);  // dH_ij/du_i
    stiffness += kGaussWeight * operator_b.transpose() * moduli * operator_b;
  }
  return 0.5 * (stiffness + stiffness.transpose());
}

}  // namespace

const std::array<ShapeGradients, kGaussPoints>& shape_gradients() {
  static const std::array<ShapeGradients, kGaussPoints> gradients = make_gradients();
  return gradients;
}

bool internal_force(const ElementVector& displacement, const material::Lame& lame, ElementVector& force) {
  Eigen::Matrix<double, 2, kElementNodes> sum = Eigen::Matrix<double, 2, kElementNodes>::Zero();
  bool usable = true;
  for (const ShapeGradients& gradients : shape_gradients()) {
    const Eigen::Matrix2d h = displacement_gradient(displacement, gradients);
    usable = usable && material::volume_change(h) > -1.0;
    sum.noalias() += (kGaussWeight * material::first_piola(h, lame)) * gradients;
  }
  force = Eigen::Map<const ElementVector>(sum.data());
  return usable;
}

double strain_energy(const ElementVector& displacement, const material::Lame& lame) {
  double energy = 0.0;
  for (const ShapeGradients& gradients : shape_gradients())
    energy += kGaussWeight * material::energy_density(displacement_gradient(displacement, gradients), lame);
  return energy;
}

const UnitStiffness& unit_stiffness() {
  static const UnitStiffness stiffness = {.shear = make_stiffness({.mu_pa = 1.0, .lambda_pa = 0.0}),
                                          .bulk = make_stiffness({.mu_pa = 0.0, .lambda_pa = 1.0})};
  return stiffness;
}

std::vector<material::Lame> lame_of(const Grid& grid) {
  std::vector<material::Lame> result(grid.phase.size());
  for (std::size_t e = 0; e < grid.phase.size(); ++e)
    if (grid.phase[e] != Phase::empty) result[e] = material::lame_from_engineering(grid.young_pa[e], grid.poisson[e]);
  return result;
}

}  // namespace nacre::fem
