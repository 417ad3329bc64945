#include "families/subfamily.hpp"

#include "base/result.hpp"

namespace nacre::families {

std::vector<pattern::Pattern> members_near(const pattern::Pattern& seed, std::span<const pattern::Pattern> family,
                                           int radius_pixels) {
  std::vector<pattern::Pattern> members = {seed};
  for (const pattern::Pattern& member : family)
    if (member != seed && pattern::pixel_difference(member, seed) <= radius_pixels) members.push_back(member);
  if (members.size() < 4)
    throw InputError::format("{}: expected at least four patterns within {} pixels, there are {}; ask for more samples",
                             seed.key(), radius_pixels, members.size());
  return members;
}

Subfamily subfamily_of(const pattern::Pattern& seed, std::span<const pattern::Pattern> family,
                       const InterpolationSettings& settings, const std::function<void(double)>& progress) {
  const auto part = [&](double first, double length) {
    return [&progress, first, length](double share) {
      if (progress) progress(first + length * share);
    };
  };
  Subfamily subfamily{.seed = seed,
                      .members = members_near(seed, family, settings.radius_pixels),
                      .sampled = 0,
                      .sampled_map = {},
                      .map = {}};
  subfamily.sampled = subfamily.members.size();
  subfamily.sampled_map = subfamily.map = isomap(earth_movers_distances(subfamily.members, part(0.0, 0.4)));
  const auto added = interpolated(seed, subfamily.members, subfamily.map.points, settings);
  if (added.empty()) return subfamily;
  subfamily.members.insert(subfamily.members.end(), added.begin(), added.end());
  subfamily.map = isomap(earth_movers_distances(subfamily.members, part(0.5, 0.5)));
  return subfamily;
}

}  // namespace nacre::families
