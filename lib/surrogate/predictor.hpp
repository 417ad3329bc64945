#pragma once
// What a search believes about patterns that nobody has simulated: one quantity, learnt from samples.

#include <Eigen/Dense>
#include <functional>
#include <span>
#include <vector>

#include "pattern/layout.hpp"

namespace nacre::surrogate {

/// Belief about the quantity of one pattern.
struct Prediction {
  double mean = 0.0;
  double deviation = 0.0;  ///< of the belief; 0 where the quantity is known
};

/// Numbers that say something of patterns: a row for each, in their order, always as many. Pure, and cheap to ask
/// again: a process asks for those of its samples whenever it is made.
using Features = std::function<Eigen::MatrixXd(std::span<const pattern::Pattern>)>;

/// A regression that has been fitted. Predictions depend on what it was fitted to alone; thread-safe.
class Predictor {
 public:
  virtual ~Predictor() = default;
  /// Best guess for each pattern.
  virtual std::vector<double> means(std::span<const pattern::Pattern> at) const = 0;
  /// With the uncertainty of each guess; dearer than means().
  virtual std::vector<Prediction> predict(std::span<const pattern::Pattern> at) const = 0;
  /// How the errors of these guesses hang together: n x n, the squared deviations of predict() on the diagonal.
  virtual Eigen::MatrixXd covariance(std::span<const pattern::Pattern> at) const = 0;
};

}  // namespace nacre::surrogate
