#include "tester/strength_scatter.hpp"

#include <cmath>

#include "base/hash.hpp"
#include "base/random.hpp"
#include "tester/strength_field.hpp"

namespace nacre::tester {

double weibull_shape(double variation) {
  // In 1/k the variation rises from 0; bisection between k = 1000 and k = 0.5 (variations 0.1 % to 220 %).
  double low = 1e-3, high = 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    const double log_ratio = std::lgamma(1.0 + 2.0 * middle) - 2.0 * std::lgamma(1.0 + middle);
    (std::expm1(log_ratio) < variation * variation ? low : high) = middle;
  }
  return 2.0 / (low + high);
}

void scatter_strength(fem::Grid& grid, int refinement, double variation, std::string_view specimen) {
  if (variation == 0.0) return;
  const double shape = weibull_shape(variation), scale = 1.0 / std::tgamma(1.0 + 1.0 / shape);
  RandomStream random(content_hash64(specimen), "strength_scatter");
  multiply_strengths(grid, refinement, [&] { return scale * std::pow(-std::log1p(-random.uniform()), 1.0 / shape); });
}

}  // namespace nacre::tester
