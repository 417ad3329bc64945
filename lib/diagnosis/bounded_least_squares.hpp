#pragma once
// Linear least squares inside bounds, by active sets (Stark and Parker, Computational Statistics 10, 1995).

#include <Eigen/Dense>

namespace nacre::diagnosis {

struct BoundedSolution {
  Eigen::VectorXd x;
  double rest = 0.0;  ///< |b - a x|^2
};

/// min |b - a x|^2 with low <= x <= high, of which 0 is one. a: rows x unknowns; an unknown whose column is zero stays
/// 0.
BoundedSolution bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& low,
                                      const Eigen::VectorXd& high);

}  // namespace nacre::diagnosis
