#pragma once
// Regression over patterns: predictions of one quantity for patterns that are not simulated, learnt from samples.

#include <Eigen/Dense>
#include <functional>
#include <span>
#include <vector>

#include "pattern/layout.hpp"

namespace nacre::surrogate {

/// Predicted quantity of one pattern.
struct PatternPrediction {
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of the prediction; 0 where the quantity is known
};

/// Features of patterns: a row for each, in their order, always as many. Pure, and cheap to compute again: a process
/// needs those of its samples whenever it is made.
using Features = std::function<Eigen::MatrixXd(std::span<const pattern::Pattern>)>;

/// A fitted regression. Predictions depend on its samples alone; thread-safe.
class Predictor {
 public:
  virtual ~Predictor() = default;
  /// Expected value for each pattern.
  virtual std::vector<double> means(std::span<const pattern::Pattern> at) const = 0;
  /// With the uncertainty of each; dearer than means().
  virtual std::vector<PatternPrediction> predict(std::span<const pattern::Pattern> at) const = 0;
  /// Covariance of the errors of these predictions: n x n, the squared deviations of predict() on the diagonal.
  virtual Eigen::MatrixXd covariance(std::span<const pattern::Pattern> at) const = 0;
};

}  // namespace nacre::surrogate
