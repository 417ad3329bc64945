#include "pattern/coupons.hpp"

#include "base/result.hpp"

namespace nacre::pattern {

Layout laminate(LayerDirection direction, int rigid_pixels, int soft_pixels) {
  const int period = rigid_pixels + soft_pixels;
  if (rigid_pixels < 1 || soft_pixels < 1 || kSide % period != 0) {
    throw InputError::format(
        "laminate of {} rigid and {} soft pixels: expected at least 1 of each and a sum that divides {}", rigid_pixels,
        soft_pixels, kSide);
  }
  Layout layout;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const int across = direction == LayerDirection::along_x ? r : c;
      layout.set(r, c, across % period < rigid_pixels);
    }
  }
  return layout;
}

Layout checkerboard(int period) {
  if (period < 1 || kSide % (2 * period) != 0) {
    throw InputError::format("checkerboard of period {}: expected 1, 2, 5 or 10 pixels", period);
  }
  Layout layout;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) layout.set(r, c, (r / period + c / period) % 2 == 0);
  }
  return layout;
}

}  // namespace nacre::pattern
