#pragma once
// Rows near known ones, without a simulation: tensor model of Schnabel and Frank (SIAM J. Numer. Anal. 21, 1984). A
// line through one point of moduli that bend with Poisson's ratios leads a fit from one end of their range to the other
// and back; the points it has passed tell the curvature along the way to them:
//   y(u) = y0 + J d + 1/2 sum over k of a_k (s_k, d)^2,   d = u - u0, s_k = u_k - u0,   y(u_k) = y_k
// with (a, b) = sum of a_i b_i scale_i^2. Past points count, the latest first, whose ways differ by 45 degrees or more.

#include <Eigen/Dense>
#include <vector>

namespace nacre::diagnosis {

/// Rows that were simulated at some coordinates.
struct KnownPoint {
  Eigen::VectorXd u, rows;
};

class LocalModel {
 public:
  /// About a point with these slopes (rows x coordinates). `scale`: of every coordinate, positive. `past`: the latest
  /// last.
  LocalModel(KnownPoint about, Eigen::MatrixXd slopes, Eigen::VectorXd scale, const std::vector<KnownPoint>& past);
  /// Rows at other coordinates.
  Eigen::VectorXd rows(const Eigen::VectorXd& u) const;
  /// Slopes there, rows x coordinates.
  Eigen::MatrixXd slopes(const Eigen::VectorXd& u) const;

 private:
  KnownPoint about_;
  Eigen::MatrixXd slopes_;
  Eigen::MatrixXd ways_;        ///< scale^2 s_k, coordinates x points
  Eigen::MatrixXd curvatures_;  ///< a_k, rows x points
};

}  // namespace nacre::diagnosis
