#include "families/subfamily.hpp"

#include "base/result.hpp"

namespace nacre::families {

Subfamily subfamily_of(const pattern::Pattern& seed, std::span<const pattern::Pattern> family,
                       const InterpolationSettings& settings, const std::function<void(double)>& progress) {
  const auto part = [&](double first, double length) {
    return [&progress, first, length](double share) {
      if (progress) progress(first + length * share);
    };
  };
  Subfamily subfamily{.seed = seed, .members = {seed}, .sampled = 0, .sampled_map = {}, .map = {}};
  for (const pattern::Pattern& member : family)
    if (member != seed && pattern::pixel_difference(member, seed) <= settings.radius_pixels)
      subfamily.members.push_back(member);
  if (subfamily.members.size() < 4)
    throw InputError::format("{}: expected at least four patterns within {} pixels, there are {}", seed.key(),
                             settings.radius_pixels, subfamily.members.size());
  subfamily.sampled = subfamily.members.size();
  subfamily.sampled_map = subfamily.map = isomap(earth_movers_distances(subfamily.members, part(0.0, 0.4)));
  const auto added = interpolated(seed, subfamily.members, subfamily.map.points, settings);
  if (added.empty()) return subfamily;
  subfamily.members.insert(subfamily.members.end(), added.begin(), added.end());
  subfamily.map = isomap(earth_movers_distances(subfamily.members, part(0.5, 0.5)));
  return subfamily;
}

}  // namespace nacre::families
