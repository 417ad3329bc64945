#pragma once
// One seed and the designs around it: the map of thesis 2.4.2, before and after interpolation.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "families/interpolation.hpp"
#include "families/isomap.hpp"

namespace nacre::families {

struct Subfamily {
  pattern::Pattern seed;
  std::vector<pattern::Pattern> members;  ///< the seed, sampled ones, then those that interpolation added
  std::size_t sampled = 0;                ///< of the members, the seed included
  Embedding sampled_map;                  ///< of the first `sampled` members, from which interpolation started
  Embedding map;                          ///< of all members
  /// Relative growth by interpolation (thesis, Table A.7: 4.5 %).
  double growth() const { return static_cast<double>(members.size() - sampled) / static_cast<double>(sampled); }
};

/// The seed and all of `family` within the radius of it. Throws InputError when there are fewer than four, too few for
/// a map.
std::vector<pattern::Pattern> members_near(const pattern::Pattern& seed, std::span<const pattern::Pattern> family,
                                           int radius_pixels = InterpolationSettings{}.radius_pixels);

/// All of `family` (its seeds among them) within the radius of the seed, mapped, interpolated and mapped again. Throws
/// InputError when fewer than four patterns lie there. `progress` gets the finished share, 0..1.
Subfamily subfamily_of(const pattern::Pattern& seed, std::span<const pattern::Pattern> family,
                       const InterpolationSettings& settings = {}, const std::function<void(double)>& progress = {});

}  // namespace nacre::families
