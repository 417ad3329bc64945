#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace nacre::families {

/// Corners of a triangle, as rows of the points.
using Triangle = std::array<int, 3>;

/// Delaunay triangulation of points in the plane (Qhull); none when all lie on a line or there are fewer than three. Of
/// equal points one is used.
std::vector<Triangle> delaunay(const Eigen::MatrixX2d& points);

}  // namespace nacre::families
