#include "diagnosis/local_model.hpp"

#include <utility>

namespace nacre::diagnosis {
namespace {

constexpr int kMostWays = 3;
constexpr double kLeastSine = 0.7071;  ///< of a way to those that count already

/// Orthonormal basis of some ways, and one more where it differs enough.
bool is_taken_in(Eigen::MatrixXd& basis, const Eigen::VectorXd& way) {
  const double length = way.norm();
  if (!(length > 0.0)) return false;
  const Eigen::VectorXd rest = way - basis * (basis.transpose() * way);
  if (rest.norm() < kLeastSine * length) return false;
  basis.conservativeResize(way.size(), basis.cols() + 1);
  basis.rightCols<1>() = rest.normalized();
  return true;
}

}  // namespace

LocalModel::LocalModel(KnownPoint about, Eigen::MatrixXd slopes, Eigen::VectorXd scale,
                       const std::vector<KnownPoint>& past)
    : about_(std::move(about)), slopes_(std::move(slopes)) {
  const Eigen::Index rows = about_.rows.size(), coordinates = about_.u.size();
  Eigen::MatrixXd basis(coordinates, 0), steps(coordinates, 0), misses(rows, 0);
  for (auto point = past.rbegin(); point != past.rend() && steps.cols() < kMostWays; ++point) {
    const Eigen::VectorXd step = point->u - about_.u;
    if (!is_taken_in(basis, scale.cwiseProduct(step))) continue;
    steps.conservativeResize(Eigen::NoChange, steps.cols() + 1);
    steps.rightCols<1>() = step;
    misses.conservativeResize(Eigen::NoChange, misses.cols() + 1);
    misses.rightCols<1>() = point->rows - about_.rows - slopes_ * step;
  }
  ways_ = scale.cwiseAbs2().asDiagonal() * steps;
  const Eigen::MatrixXd half_squares = 0.5 * (steps.transpose() * ways_).cwiseAbs2();
  curvatures_ = half_squares.ldlt().solve(misses.transpose()).transpose();
}

Eigen::VectorXd LocalModel::rows(const Eigen::VectorXd& u) const {
  const Eigen::VectorXd step = u - about_.u;
  return about_.rows + slopes_ * step + 0.5 * curvatures_ * (ways_.transpose() * step).cwiseAbs2();
}

Eigen::MatrixXd LocalModel::slopes(const Eigen::VectorXd& u) const {
  return slopes_ + curvatures_ * (ways_.transpose() * (u - about_.u)).asDiagonal() * ways_.transpose();
}

}  // namespace nacre::diagnosis
