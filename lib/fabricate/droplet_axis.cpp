#include "fabricate/droplet_axis.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fabricate/printer.hpp"

namespace nacre::fabricate {
namespace {

/// Number of droplets whose centre lies before `position_um`: that position in droplets, rounded. Exact.
std::int64_t droplets_before(std::int64_t position_um, std::int64_t dpi) {
  return (2 * position_um * dpi + kMicrometresPerInch) / (2 * kMicrometresPerInch);
}

}  // namespace

DropletAxis::DropletAxis(int dpi, std::int64_t length_um, std::int64_t pixel_um)
    : pitch_mm_(pitch_mm(dpi)), dpi_(dpi), length_um_(length_um), pixel_um_(pixel_um) {
  assert(length_um > 0 && length_um % 2 == 0 && pixel_um > 0);
  places_.resize(droplets_before(length_um, dpi));
  // The first pixel may be cut by the specimen's edge: whole pixels from the middle outwards, and one more.
  const std::int64_t reach = (length_um / 2 + pixel_um - 1) / pixel_um;
  for (std::int64_t pixel = -reach; pixel < reach; ++pixel) {
    const int begin = begin_of(pixel), end = begin_of(pixel + 1);
    const int width = interface_droplets(end - begin);
    for (int droplet = begin; droplet < end; ++droplet) {
      const bool at_low_edge = droplet - begin < width && begin > 0;
      const bool at_high_edge = end - droplet <= width && end < droplets();
      const auto here = static_cast<std::int32_t>(pixel);
      places_[droplet] = {here, at_low_edge ? here - 1 : at_high_edge ? here + 1 : here};
    }
  }
}

int DropletAxis::begin_of(std::int64_t pixel) const {
  const std::int64_t edge_um = std::clamp<std::int64_t>(length_um_ / 2 + pixel * pixel_um_, 0, length_um_);
  return static_cast<int>(droplets_before(edge_um, dpi_));
}

}  // namespace nacre::fabricate
