#include "fabricate/slice.hpp"

namespace nacre::fabricate {

DropletCount count_droplets(const Slice& slice) {
  DropletCount count{};
  for (const Droplet droplet : slice.droplets) ++count[static_cast<std::size_t>(droplet)];
  return count;
}

double rigid_fraction(const DropletCount& count) {
  const auto printed = static_cast<double>(count[1] + count[2]);
  return printed > 0.0 ? static_cast<double>(count[2]) / printed : 0.0;
}

}  // namespace nacre::fabricate
