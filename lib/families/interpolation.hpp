#pragma once

#include <span>
#include <vector>

#include "families/delaunay.hpp"
#include "pattern/layout.hpp"

namespace nacre::families {

struct InterpolationSettings {
  double shortest_edge = 0.04, longest_edge = 0.40;  ///< of a triangle's longest edge, over the diameter of the map
  int divisions = 4;                                 ///< of a triangle's sides: weights are multiples of 1 / divisions
  int radius_pixels = 16;                            ///< to the seed
};

/// Triangles whose longest edge is within the limits.
std::vector<Triangle> candidate_triangles(const Eigen::MatrixX2d& points, const InterpolationSettings& settings = {});

/// Patterns between the members of a subfamily that dense sampling did not find (thesis 2.4.2): barycentres on a
/// uniform grid in every candidate triangle of the map, within the radius of the seed, feasible, each once and none of
/// the members. `points`: the map, one row per member.
std::vector<pattern::Pattern> interpolated(const pattern::Pattern& seed, std::span<const pattern::Pattern> members,
                                           const Eigen::MatrixX2d& points, const InterpolationSettings& settings = {});

}  // namespace nacre::families
