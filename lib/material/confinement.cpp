#include "material/confinement.hpp"

#include <algorithm>

#include "material/extensions.hpp"
#include "material/neo_hookean.hpp"

namespace nacre::material {
namespace {

constexpr double kStandardThicknessMm = 3.2;
/// Beyond it plane strain would be stiff without limit, and no print is.
constexpr double kLargestPoisson = 0.49;

}  // namespace

double plane_strain_share(const Extensions& extensions, double thickness_mm) {
  const double value = extension_value(extensions, "plane_strain");
  return value * thickness_mm / (value * thickness_mm + (1.0 - value) * kStandardThicknessMm);
}

Constants confined(const Constants& constants, double share) {
  if (share == 0.0) return constants;
  const Lame free = lame_from_engineering(constants.young_pa, constants.poisson);
  const double nu = std::min(constants.poisson, kLargestPoisson);
  const double held_lambda_pa = std::max(free.lambda_pa, 2.0 * free.mu_pa * nu / (1.0 - 2.0 * nu));
  const double lambda_pa = free.lambda_pa + share * (held_lambda_pa - free.lambda_pa);
  // E and nu of the law (2.2, 2.3) with mu and lambda: lambda = 2 mu nu / (1 - nu).
  const double poisson = lambda_pa / (lambda_pa + 2.0 * free.mu_pa);
  return {.young_pa = 2.0 * free.mu_pa * (1.0 + poisson),
          .poisson = poisson,
          .threshold_j_per_m3 = constants.threshold_j_per_m3};
}

}  // namespace nacre::material
