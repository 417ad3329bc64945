#include "diagnosis/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "base/statistics.hpp"

namespace nacre::diagnosis {
namespace {

/// Standard deviation of single readings, from the distance of each to the line between its neighbours; the median, so
/// that bends do not count.
double scatter_of(const tester::Curve& curve) {
  std::vector<double> deviations;
  for (std::size_t k = 1; k + 1 < curve.size(); ++k) {
    const double length = curve.strain[k + 1] - curve.strain[k - 1];
    const double t = length > 0.0 ? (curve.strain[k] - curve.strain[k - 1]) / length : 0.5;
    const double between = (1.0 - t) * curve.stress_pa[k - 1] + t * curve.stress_pa[k + 1];
    deviations.push_back(std::abs(curve.stress_pa[k] - between) / std::sqrt(1.0 + t * t + (1.0 - t) * (1.0 - t)));
  }
  constexpr double kMedianOfNormal = 0.6745;
  return quantile(std::move(deviations), 0.5) / kMedianOfNormal;
}

/// Stress at the ends of `pieces` pieces, by least squares.
Eigen::VectorXd knots_of(const tester::Curve& curve, int pieces) {
  constexpr double kRidge = 1e-6;  // smallest curvature where there are no readings
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(pieces + 1, pieces + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(pieces + 1);
  const double begin = curve.strain.front(), length = (curve.strain.back() - begin) / pieces;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double place = (curve.strain[k] - begin) / length;
    const int piece = std::min(static_cast<int>(place), pieces - 1);
    const Eigen::Vector2d hats(1.0 - (place - piece), place - piece);
    normal.block<2, 2>(piece, piece) += hats * hats.transpose();
    right.segment<2>(piece) += curve.stress_pa[k] * hats;
  }
  const Eigen::Vector3d bend(1.0, -2.0, 1.0);
  for (int knot = 0; knot + 2 <= pieces; ++knot) normal.block<3, 3>(knot, knot) += kRidge * bend * bend.transpose();
  return normal.ldlt().solve(right);
}

}  // namespace

tester::Curve smoothed(const tester::Curve& curve, const CurveReading& reading) {
  if (curve.size() < static_cast<std::size_t>(reading.fewest_readings) || curve.strain.back() <= curve.strain.front())
    return curve;
  const double scatter = scatter_of(curve) / *std::max_element(curve.stress_pa.begin(), curve.stress_pa.end());
  if (!(scatter > reading.quiet_scatter)) return curve;
  const double readings_per_knot = std::max(reading.fewest_per_knot, std::pow(scatter / reading.knot_scatter, 2));
  const int pieces = static_cast<int>(
      std::clamp(static_cast<double>(curve.size()) / readings_per_knot, reading.fewest_pieces, reading.most_pieces));
  const Eigen::VectorXd knots = knots_of(curve, pieces);
  tester::Curve smooth;
  for (int knot = 0; knot <= pieces; ++knot) {
    const double t = static_cast<double>(knot) / pieces;
    smooth.strain.push_back((1.0 - t) * curve.strain.front() + t * curve.strain.back());
    smooth.stress_pa.push_back(knots[knot]);
  }
  return smooth;
}

}  // namespace nacre::diagnosis
