#include "material/neo_hookean.hpp"

#include <cassert>

namespace nacre::material {

Lame lame_from_engineering(double young_pa, double poisson) {
  const double nu = poisson / (1.0 + poisson);                                                              // Eq. 2.3
  const double young = young_pa * (1.0 + 2.0 * poisson) / ((1.0 + poisson) * (1.0 + poisson));              // Eq. 2.3
  return {.mu_pa = young / (2.0 * (1.0 + nu)), .lambda_pa = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))};  // Eq. 2.2
}

Eigen::Matrix4d tangent(const Eigen::Matrix2d& h, const Lame& lame) {
  const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + h;
  const Eigen::Matrix2d g = f.inverse().transpose();
  const double shear = lame.mu_pa - lame.lambda_pa * std::log1p(volume_change(h));
  // A_iJkL = mu d_ik d_JL + (mu - lambda ln J) G_iL G_kJ + lambda G_iJ G_kL with G = F^-T.
  Eigen::Matrix4d result;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          result(2 * i + j, 2 * k + l) =
              (i == k && j == l ? lame.mu_pa : 0.0) + shear * g(i, l) * g(k, j) + lame.lambda_pa * g(i, j) * g(k, l);
  return result;
}

UniaxialState uniaxial_stress(double strain, const Lame& lame) {
  assert(strain > -1.0);
  const double log_f22 = std::log1p(strain);
  // s = ln F11 solves mu (e^2s - 1) + lambda (s + ln F22) = 0, whose left side rises and is convex in s.
  double s = -0.5 * log_f22;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double residual = lame.mu_pa * std::expm1(2.0 * s) + lame.lambda_pa * (s + log_f22);
    const double step = residual / (2.0 * lame.mu_pa * std::exp(2.0 * s) + lame.lambda_pa);
    s -= step;
    if (std::abs(step) <= 1e-15 * std::abs(s)) break;
  }
  // F22^2 - F11^2 from the differences to one.
  const double difference = strain * (2.0 + strain) - std::expm1(2.0 * s);
  return {.lateral_stretch = std::exp(s), .nominal_stress_pa = lame.mu_pa * difference / (1.0 + strain)};
}

}  // namespace nacre::material
