#include "material/blend_law.hpp"

#include <cmath>

#include "material/extensions.hpp"

namespace nacre::material {

double blend_factor(const Extensions& extensions, double rigid_fraction) {
  const double bulge = extension_value(extensions, "blend_law");
  if (bulge == 0.0) return 1.0;
  const double way = rigid_fraction < 0.5 ? 2.0 * rigid_fraction : 2.0 * rigid_fraction - 1.0;
  return std::exp(bulge * 4.0 * way * (1.0 - way));
}

}  // namespace nacre::material
