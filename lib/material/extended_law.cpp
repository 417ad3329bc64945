#include "material/extended_law.hpp"

#include <algorithm>
#include <cmath>

#include "material/extensions.hpp"

namespace nacre::material {
namespace {

/// Share of J_m from which chains stretch on at this stiffness: a singular law would have no state for a coupon that is
/// pulled farther than some J_m allows.
constexpr double kFullChains = 0.98;

/// SymmetricTensor tensors by components 11, 22, 12.
using SymmetricTensor = std::array<double, 3>;

SymmetricTensor scaled_sum(double a, const SymmetricTensor& x, double b, const SymmetricTensor& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

/// C_e - 1 for the elastic part of the displacement gradient.
SymmetricTensor strain_of(const Eigen::Matrix2d& h) {
  const double a = h(0, 0), b = h(0, 1), c = h(1, 0), d = h(1, 1);
  return {2.0 * a + a * a + c * c, 2.0 * d + d * d + b * b, b + c + a * b + c * d};
}

/// The elastic state of a point; half = I / 2, deviator half the difference of the squares of the principal stretches.
struct Elastic {
  double change, log_j;     ///< J_e - 1, ln J_e
  SymmetricTensor inverse;  ///< C_e^-1
  SymmetricTensor plastic;  ///< G - 1
  double half, deviator;
};

Elastic elastic_state(const Eigen::Matrix2d& h, const SymmetricTensor& plastic) {
  const SymmetricTensor x = strain_of(h);
  Elastic e{.change = volume_change(h), .log_j = 0.0, .inverse = {}, .plastic = plastic, .half = 0.0, .deviator = 0.0};
  e.log_j = std::log1p(e.change);
  const double square = (1.0 + e.change) * (1.0 + e.change);
  e.inverse = {(1.0 + x[1]) / square, (1.0 + x[0]) / square, -x[2] / square};
  e.half = 0.5 * (x[0] + x[1] + plastic[0] * (1.0 + x[0]) + plastic[1] * (1.0 + x[1]) + 2.0 * plastic[2] * x[2]);
  e.deviator = std::sqrt(std::max(0.0, (e.half - e.change) * (2.0 + e.half + e.change)));
  return e;
}

/// Flow: scales the deviator back to Y / (2 mu) and returns the dissipated energy.
double flow(const ExtendedLaw& law, Elastic& e) {
  const double limit = law.yield_pa / (2.0 * law.lame.mu_pa);
  if (!(e.deviator > limit)) return 0.0;
  const double ratio = limit / e.deviator, j = 1.0 + e.change;
  const double trace = std::sqrt(j * j + limit * limit), old_trace = 1.0 + e.half;
  const double kappa = trace - ratio * old_trace;
  e.plastic = scaled_sum(ratio, e.plastic, kappa, e.inverse);
  for (const std::size_t i : {0u, 1u}) e.plastic[i] += ratio - 1.0;
  const double spent = law.lame.mu_pa * (e.deviator - limit) * (e.deviator + limit) / (trace + old_trace);
  e.half = trace - 1.0;
  e.deviator = limit;
  return spent;
}

/// mu times the part of I - 2 l that a principal stretch of square 1 + x holds, where it is shorter than at rest.
double shortened(double x) { return x < 0.0 ? x - std::log1p(x) : 0.0; }

/// The compressive part of the energy density: of shortened principal stretches and lost area.
double compressive_energy(const Lame& lame, const Elastic& e) {
  const double principal = shortened(e.half - e.deviator) + shortened(e.half + e.deviator);
  return 0.5 * (lame.mu_pa * principal + (e.log_j < 0.0 ? lame.lambda_pa * e.log_j * e.log_j : 0.0));
}

/// Advances the Maxwell branch to stress `s`, exactly for a stress that grew evenly over the step; returns its energy.
double relax(const ExtendedLaw& law, const SymmetricTensor& s, double dt_s, PointHistory& history) {
  const double steps = dt_s / law.relaxation_time_s;
  const double kept = std::exp(-steps), passed = steps > 0.0 ? -std::expm1(-steps) / steps : 1.0;
  for (std::size_t i = 0; i < 3; ++i)
    history.overstress[i] = kept * history.overstress[i] + passed * law.overstress * (s[i] - history.stress[i]);
  history.stress = s;
  const SymmetricTensor& q = history.overstress;
  const double trace = q[0] + q[1], share = law.lame.lambda_pa / (2.0 * (law.lame.lambda_pa + law.lame.mu_pa));
  const double square = q[0] * q[0] + q[1] * q[1] + 2.0 * q[2] * q[2] - share * trace * trace;
  return square / (4.0 * law.lame.mu_pa * law.overstress);
}

/// Integrity, the share of stress left by softening, at failure energy `energy`.
double integrity_at(const ExtendedLaw& law, double energy) {
  const double s = std::sqrt(std::max(0.0, energy / law.threshold_j_per_m3)), last = 1.0 + law.softening;
  if (s <= 1.0) return 1.0;
  return s >= last ? 0.0 : (last - s) / (s * law.softening);
}

}  // namespace

bool LawExtensions::any() const { return *this != LawExtensions{}; }

LawExtensions law_extensions(const Extensions& extensions) {
  const double limit = extension_value(extensions, "soft_stiffening"),
               overstress = extension_value(extensions, "rate_dependence", 0),
               relaxation_time_s = extension_value(extensions, "rate_dependence", 1);
  const bool branch = overstress > 0.0 && relaxation_time_s > 0.0;
  return {.yield_pa = extension_value(extensions, "rigid_yield"),
          .inverse_limit = limit > 0.0 ? 1.0 / limit : 0.0,
          .overstress = branch ? overstress : 0.0,
          .relaxation_time_s = branch ? relaxation_time_s : 0.0,
          .softening = extension_value(extensions, "progressive_damage"),
          .tension_only = extension_value(extensions, "tension_only_failure"),
          .shrinkage = extension_value(extensions, "residual_strain")};
}

double rigid_share(double rigid_fraction) { return std::max(0.0, 2.0 * rigid_fraction - 1.0); }
double soft_share(double rigid_fraction) { return std::max(0.0, 1.0 - 2.0 * rigid_fraction); }

double rate_stiffening(const LawExtensions& extensions, double strain_rate_per_s) {
  if (extensions.overstress == 0.0) return 1.0;
  const double tau = extensions.relaxation_time_s, first = kFirstChordStrain / strain_rate_per_s / tau,
               last = kLastChordStrain / strain_rate_per_s / tau;
  return 1.0 - extensions.overstress * std::exp(-first) * std::expm1(first - last) / (last - first);
}

double held_stiffening(const LawExtensions& extensions, double time_s) {
  if (extensions.overstress == 0.0) return 1.0;
  return 1.0 + extensions.overstress * std::exp(-time_s / extensions.relaxation_time_s);
}

ExtendedLaw extended_law(const LawExtensions& extensions, const Lame& lame, double threshold_j_per_m3,
                         double rigid_fraction) {
  ExtendedLaw law{.lame = lame, .threshold_j_per_m3 = threshold_j_per_m3};
  law.eigenstrain = -extensions.shrinkage * rigid_fraction;
  law.inverse_limit = extensions.inverse_limit * soft_share(rigid_fraction);
  if (extensions.yield_pa > 0.0 && rigid_share(rigid_fraction) > 0.0)
    law.yield_pa = extensions.yield_pa / rigid_share(rigid_fraction);
  law.overstress = extensions.overstress;
  law.relaxation_time_s = extensions.relaxation_time_s;
  law.softening = extensions.softening;
  law.tension_only = extensions.tension_only;
  return law;
}

PointResponse respond(const Eigen::Matrix2d& h, double dt_s, const ExtendedLaw& law, PointHistory& history) {
  const Eigen::Matrix2d elastic_h = (h - law.eigenstrain * Eigen::Matrix2d::Identity()) / (1.0 + law.eigenstrain);
  Elastic e = elastic_state(elastic_h, history.plastic);
  history.plastic_work_j_per_m3 += flow(law, e);
  history.plastic = e.plastic;
  const double k = 2.0 * (e.half - e.log_j), filled = std::min(law.inverse_limit * k, kFullChains);
  const double shear = law.lame.mu_pa / (1.0 - filled), pressure = law.lame.lambda_pa * e.log_j;
  SymmetricTensor s = scaled_sum(shear, e.plastic, pressure - shear, e.inverse);
  for (const std::size_t i : {0u, 1u}) s[i] += shear;
  const double chains = law.inverse_limit > 0.0 ? -std::log1p(-filled) / law.inverse_limit +
                                                      (k - filled / law.inverse_limit) / (1.0 - filled)
                                                : k;
  double energy = 0.5 * (law.lame.mu_pa * chains + pressure * e.log_j) + history.plastic_work_j_per_m3;
  if (law.tension_only > 0.0) energy -= law.tension_only * compressive_energy(law.lame, e);
  if (law.overstress > 0.0) {
    energy += relax(law, s, dt_s, history);
    s = scaled_sum(1.0, s, 1.0, history.overstress);
  }
  if (law.softening > 0.0) history.integrity = std::min(history.integrity, integrity_at(law, energy));
  Eigen::Matrix2d second;
  second << s[0], s[2], s[2], s[1];
  return {.stress_pa = history.integrity * (Eigen::Matrix2d::Identity() + h).lazyProduct(second),
          .failure_energy_j_per_m3 = energy};
}

double stiffest_tangent_pa(const ExtendedLaw& law, double energy_j_per_m3) {
  const double mu = law.lame.mu_pa, base = law.lame.lambda_pa + 2.0 * mu;
  // -mu J_m / 2 ln(1 - K / J_m) is at most the energy. Beyond g times the base law's tangent there is 2 mu g^2 / J_m
  // |F - F^-T|^2, and |F - F^-T|^2 <= 2 K where nothing is shortened much.
  const double g = std::exp(2.0 * law.inverse_limit * energy_j_per_m3 / mu);
  const double stiffening = law.inverse_limit == 0.0 ? 0.0 : (g - 1.0) * base + 4.0 * mu * g * (g - 1.0);
  return (1.0 + law.overstress) * (base + stiffening);
}

}  // namespace nacre::material
