#include "families/interpolation.hpp"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "base/parallel.hpp"
#include "families/barycentre.hpp"
#include "pattern/constraints.hpp"

namespace nacre::families {
namespace {

using pattern::Pattern;

/// Distance between the two points farthest from each other.
double diameter(const Eigen::MatrixX2d& points) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) largest = std::max(largest, (points.row(i) - points.row(j)).norm());
  return largest;
}

double longest_edge(const Eigen::MatrixX2d& points, const Triangle& triangle) {
  return std::max({(points.row(triangle[0]) - points.row(triangle[1])).norm(),
                   (points.row(triangle[1]) - points.row(triangle[2])).norm(),
                   (points.row(triangle[2]) - points.row(triangle[0])).norm()});
}

/// Barycentres on the grid of one triangle, its corners left out; weights of zero are left out with their corner.
std::vector<Pattern> between(std::span<const Pattern> members, const Triangle& triangle, int divisions) {
  std::vector<Pattern> found;
  for (int a = 0; a <= divisions; ++a) {
    for (int b = 0; b <= divisions - a; ++b) {
      const int parts[3] = {a, b, divisions - a - b};
      std::vector<Pattern> sources;
      std::vector<double> weights;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (parts[corner] == 0) continue;
        sources.push_back(members[triangle[corner]]);
        weights.push_back(parts[corner]);
      }
      if (sources.size() < 2) continue;
      if (const std::optional<Pattern> pattern = barycentre(sources, weights)) found.push_back(*pattern);
    }
  }
  return found;
}

}  // namespace

std::vector<Triangle> candidate_triangles(const Eigen::MatrixX2d& points, const InterpolationSettings& settings) {
  const double size = diameter(points);
  std::vector<Triangle> triangles = delaunay(points);
  std::erase_if(triangles, [&](const Triangle& triangle) {
    const double edge = longest_edge(points, triangle);
    return edge < settings.shortest_edge * size || edge > settings.longest_edge * size;
  });
  return triangles;
}

std::vector<Pattern> interpolated(const Pattern& seed, std::span<const Pattern> members, const Eigen::MatrixX2d& points,
                                  const InterpolationSettings& settings) {
  const std::vector<Triangle> triangles = candidate_triangles(points, settings);
  std::vector<std::vector<Pattern>> found(triangles.size());
  parallel_for(triangles.size(), [&](int i) { found[i] = between(members, triangles[i], settings.divisions); });
  std::unordered_set<std::uint64_t> known;
  for (const Pattern& member : members) known.insert(member.bits());
  std::vector<Pattern> result;
  for (const std::vector<Pattern>& patterns : found) {
    for (const Pattern& pattern : patterns) {
      const bool usable =
          pattern::pixel_difference(pattern, seed) <= settings.radius_pixels && pattern::is_feasible(pattern);
      if (usable && known.insert(pattern.bits()).second) result.push_back(pattern);
    }
  }
  return result;
}

}  // namespace nacre::families
