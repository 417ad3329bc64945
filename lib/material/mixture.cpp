#include "material/mixture.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace nacre::material {
namespace {

double linear(double from, double to, double share) { return from + share * (to - from); }

double geometric(double from, double to, double share) {
  if (from == to) return from;  // also where both are infinite
  return std::pow(10.0, linear(std::log10(from), std::log10(to), share));
}

Constants between(const Constants& from, const Constants& to, double share) {
  return {.young_pa = geometric(from.young_pa, to.young_pa, share),
          .poisson = linear(from.poisson, to.poisson, share),
          .threshold_j_per_m3 = geometric(from.threshold_j_per_m3, to.threshold_j_per_m3, share)};
}

}  // namespace

Phases phases_of(const ModulusParameters& p) {
  constexpr double never = std::numeric_limits<double>::infinity();
  return {.soft = {p.e_tb_pa, p.nu_tb, never},
          .interface = {p.e_if_pa, p.nu_if, never},
          .rigid = {p.e_vw_pa, p.nu_vw, never}};
}

Phases phases_of(const ToughnessParameters& p) {
  return {.soft = {p.e_tb_pa, p.nu_tb, p.w_tb_j_per_m3},
          .interface = {p.e_if_pa, p.nu_if, p.w_if_j_per_m3},
          .rigid = {p.e_vw_pa, p.nu_vw, p.w_vw_j_per_m3}};
}

Constants mixture(const Phases& phases, double rigid_fraction) {
  assert(rigid_fraction >= 0.0 && rigid_fraction <= 1.0);
  if (rigid_fraction <= 0.0) return phases.soft;
  if (rigid_fraction >= 1.0) return phases.rigid;
  if (rigid_fraction == 0.5) return phases.interface;
  if (rigid_fraction < 0.5) return between(phases.soft, phases.interface, 2.0 * rigid_fraction);
  return between(phases.interface, phases.rigid, 2.0 * rigid_fraction - 1.0);
}

}  // namespace nacre::material
