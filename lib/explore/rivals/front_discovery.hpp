#pragma once
// A dense front of two smooth functions over a box: stochastic local search and expansion along the front (Schulz et
// al. 2018, as DGEMO uses it).

#include <array>
#include <vector>

#include <Eigen/Dense>

#include "base/random.hpp"

namespace nacre::explore {

/// Two functions to be minimised over [0, edge]^d, with gradients.
class SmoothPair {
 public:
  virtual ~SmoothPair() = default;
  virtual Eigen::Vector2d values(const Eigen::VectorXd& at) const = 0;
  virtual Eigen::VectorXd gradient(int objective, const Eigen::VectorXd& at) const = 0;
  /// Values at the rows of `at`: points x 2.
  virtual Eigen::MatrixX2d values_all(const Eigen::MatrixXd& at) const = 0;
};

/// A point of the front's neighbourhood; points found by expansion from one local optimum share its family.
struct FrontPoint {
  Eigen::VectorXd at;
  Eigen::Vector2d values;
  int family = 0;
};

struct DiscoverySettings {
  double edge = 1.0;        ///< of the box
  int generations = 10;     ///< as shipped
  int local_searches = 30;  ///< of a generation (shipped: 100)
  int cells = 100;          ///< angular cells of the buffer, as shipped
  int cell_points = 10;     ///< kept in a cell, as shipped
};

/// Points by angular cell, nearest to the ideal point first; cells without points are left out.
std::vector<std::vector<FrontPoint>> discover_front(const SmoothPair& pair, const std::vector<Eigen::VectorXd>& start,
                                                    const DiscoverySettings& settings, RandomStream& random);

}  // namespace nacre::explore
