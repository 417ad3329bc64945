// A repeated unit as the laboratory's printer lays it down.

#include <gtest/gtest.h>

#include <numeric>

#include "laboratory/laid_unit.hpp"
#include "pattern/coupons.hpp"

namespace nacre::laboratory {
namespace {

double rigid_share(const pattern::Layout& layout, double growth_pixels) {
  HiddenEffects effects;
  effects.rigid_overprint_pixels = growth_pixels;
  const std::vector<double> fractions = unit_of(layout, effects).rigid_fraction;
  return std::accumulate(fractions.begin(), fractions.end(), 0.0) / static_cast<double>(fractions.size());
}

// Layers of five pixels: each rigid one becomes thicker by the growth on either side, however small it is against an
// element.
TEST(LaidUnit, RigidRegionsGrowByWhatTheyAreSaidTo) {
  for (const auto direction : {pattern::LayerDirection::along_x, pattern::LayerDirection::along_y}) {
    const pattern::Layout layers = pattern::laminate(direction, 5, 5);
    const double before = rigid_share(layers, 0.0);
    for (const double growth : {0.03, 0.06, 0.1, 0.17, 0.2, 0.36}) {
      const double thicker_by_pixels = (rigid_share(layers, growth) - before) * 10.0;
      EXPECT_NEAR(thicker_by_pixels, 2.0 * growth, 1e-9) << growth;
    }
  }
}

}  // namespace
}  // namespace nacre::laboratory
