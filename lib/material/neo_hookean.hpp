#pragma once
// The compressible neo-Hookean law in two dimensions, unit thickness. Symbols: F = I + H deformation gradient, J = det
// F, P first Piola-Kirchhoff stress, mu and lambda Lame parameters. Everything is computed from H, because at a strain
// of 1e-4 the form F - F^-T loses four digits to cancellation.

#include <cmath>

#include <Eigen/Dense>

namespace nacre::material {

/// Lame parameters of the two-dimensional law, Pa.
struct Lame {
  double mu_pa = 0.0;
  double lambda_pa = 0.0;
  bool operator==(const Lame&) const = default;
};

/// Eqs. 2.2 and 2.3: from E (Pa, > 0) and nu (0 to 0.5) through the plane-stress equivalents E' and nu'. A small
/// uniaxial stress then gives E and nu back; lambda stays finite at nu = 0.5.
Lame lame_from_engineering(double young_pa, double poisson);

/// J - 1 = tr H + det H.
inline double volume_change(const Eigen::Matrix2d& h) { return h.trace() + h.determinant(); }

/// Eq. 2.1 as corrected, W = mu/2 (I1 - 2 - 2 ln J) + lambda/2 (ln J)^2, J/m^3. Requires J > 0.
inline double energy_density(const Eigen::Matrix2d& h, const Lame& lame) {
  const double change = volume_change(h);
  const double log_j = std::log1p(change);
  // I1 - 2 = 2 tr H + |H|^2 = 2 (J - 1) - 2 det H + |H|^2.
  const double isochoric = 2.0 * (change - log_j) - 2.0 * h.determinant() + h.squaredNorm();
  return 0.5 * (lame.mu_pa * isochoric + lame.lambda_pa * log_j * log_j);
}

/// P = dW/dF = mu (F - F^-T) + lambda ln J F^-T, Pa. Requires J > 0. Zero at H = 0.
inline Eigen::Matrix2d first_piola(const Eigen::Matrix2d& h, const Lame& lame) {
  const double change = volume_change(h);
  const double inverse_j = 1.0 / (1.0 + change);
  const double log_j = std::log1p(change);
  Eigen::Matrix2d cofactor;  // J F^-T
  cofactor << 1.0 + h(1, 1), -h(1, 0), -h(0, 1), 1.0 + h(0, 0);
  // J (F - F^-T) = (J - 1) F + (F - cofactor), the last without the unit matrix.
  Eigen::Matrix2d deviation;
  const double difference = h(0, 0) - h(1, 1), sum = h(0, 1) + h(1, 0);
  deviation << difference, sum, sum, -difference;
  deviation += change * (Eigen::Matrix2d::Identity() + h);
  return (lame.mu_pa * inverse_j) * deviation + (lame.lambda_pa * log_j * inverse_j) * cofactor;
}

/// dP/dF as a 4 x 4 matrix over the components (11, 12, 21, 22), Pa; symmetric. Requires J > 0.
Eigen::Matrix4d tangent(const Eigen::Matrix2d& h, const Lame& lame);

/// A material point under uniaxial stress along y.
struct UniaxialState {
  double lateral_stretch = 1.0;    ///< F11
  double nominal_stress_pa = 0.0;  ///< P22
};

/// The state at nominal strain F22 - 1 > -1 with no lateral stress: mu (F11^2 - 1) + lambda ln (F11 F22) = 0, then
/// P22 = mu (F22^2 - F11^2) / F22. Newton iteration in ln F11, which converges from anywhere.
UniaxialState uniaxial_stress(double strain, const Lame& lame);

}  // namespace nacre::material
