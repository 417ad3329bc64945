#pragma once
// Points of the unit cube as Eigen sees them.

#include <Eigen/Dense>
#include <vector>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

inline Eigen::VectorXd to_vector(const Point& point) {
  return Eigen::Map<const Eigen::VectorXd>(point.data(), point.size());
}
inline Point to_point(const Eigen::VectorXd& vector) { return {vector.data(), vector.data() + vector.size()}; }

/// One point a row.
inline Eigen::MatrixXd to_rows(const std::vector<Point>& points, int dimension) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), dimension);
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = to_vector(points[i]).transpose();
  return rows;
}

}  // namespace nacre::optimize
