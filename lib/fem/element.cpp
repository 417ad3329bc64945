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
    result[point] << -(1 - y), 1 - y, -y, y, -(1 - x), -x, 1 - x, x;
  }
  return result;
}

ElementMatrix make_stiffness(const material::Lame& lame, double width, double height) {
  const Eigen::Matrix4d moduli = material::tangent(Eigen::Matrix2d::Zero(), lame);
  const double sizes[2] = {width, height};
  ElementMatrix stiffness = ElementMatrix::Zero();
  for (const ShapeGradients& gradients : shape_gradients()) {
    Eigen::Matrix<double, 4, 2 * kElementNodes> operator_b = Eigen::Matrix<double, 4, 2 * kElementNodes>::Zero();
    for (int node = 0; node < kElementNodes; ++node)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) operator_b(2 * i + j, 2 * node + i) = gradients(j, node) / sizes[j];  // dH_ij/du_i
    stiffness += kGaussWeight * width * height * operator_b.transpose() * moduli * operator_b;
  }
  return 0.5 * (stiffness + stiffness.transpose());
}

}  // namespace

const std::array<ShapeGradients, kGaussPoints>& shape_gradients() {
  static const std::array<ShapeGradients, kGaussPoints> gradients = make_gradients();
  return gradients;
}

bool internal_force(const ElementVector& displacement, const material::Lame& lame, ElementVector& force) {
  // first_piola and displacement_gradient, written out. The solvers have their own kernels.
  double fx[kElementNodes] = {}, fy[kElementNodes] = {};
  bool usable = true;
  for (const ShapeGradients& gradients : shape_gradients()) {
    const double* g = gradients.data();  // dN_a/dx, dN_a/dy in turn
    double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
    for (int a = 0; a < kElementNodes; ++a) {
      xx += displacement[2 * a] * g[2 * a];
      xy += displacement[2 * a] * g[2 * a + 1];
      yx += displacement[2 * a + 1] * g[2 * a];
      yy += displacement[2 * a + 1] * g[2 * a + 1];
    }
    const double change = xx + yy + (xx * yy - xy * yx);
    usable = usable && change > -1.0;
    const double inverse_j = 1.0 / (1.0 + change);
    const double mu = kGaussWeight * lame.mu_pa * inverse_j;
    const double bulk = kGaussWeight * lame.lambda_pa * inverse_j * std::log1p(change);
    const double pxx = mu * (xx - yy + change * (1.0 + xx)) + bulk * (1.0 + yy);
    const double pxy = mu * (xy + yx + change * xy) - bulk * yx;
    const double pyx = mu * (xy + yx + change * yx) - bulk * xy;
    const double pyy = mu * (yy - xx + change * (1.0 + yy)) + bulk * (1.0 + xx);
    for (int a = 0; a < kElementNodes; ++a) {
      fx[a] += pxx * g[2 * a] + pxy * g[2 * a + 1];
      fy[a] += pyx * g[2 * a] + pyy * g[2 * a + 1];
    }
  }
  for (int a = 0; a < kElementNodes; ++a) {
    force[2 * a] = fx[a];
    force[2 * a + 1] = fy[a];
  }
  return usable;
}

double strain_energy(const ElementVector& displacement, const material::Lame& lame) {
  double energy = 0.0;
  for (const ShapeGradients& gradients : shape_gradients())
    energy += kGaussWeight * material::energy_density(displacement_gradient(displacement, gradients), lame);
  return energy;
}

UnitStiffness rectangle_stiffness(double width, double height) {
  return {.shear = make_stiffness({.mu_pa = 1.0, .lambda_pa = 0.0}, width, height),
          .bulk = make_stiffness({.mu_pa = 0.0, .lambda_pa = 1.0}, width, height)};
}

const UnitStiffness& unit_stiffness() {
  static const UnitStiffness stiffness = rectangle_stiffness(1.0, 1.0);
  return stiffness;
}

std::vector<material::Lame> lame_of(const Grid& grid) {
  std::vector<material::Lame> result(grid.phase.size());
  for (std::size_t e = 0; e < grid.phase.size(); ++e)
    if (grid.phase[e] != Phase::empty) result[e] = material::lame_from_engineering(grid.young_pa[e], grid.poisson[e]);
  return result;
}

}  // namespace nacre::fem
