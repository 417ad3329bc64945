#pragma once
// How probable parameters are, given the features that they predict: the posterior density of eta with residuals of
// log T and log peak stress as Student's t.

#include <span>

#include "sysid/emulator.hpp"

namespace nacre::sysid {

/// Residuals of log T and log peak stress are normal and independent, each feature with a variance of its own that is
/// not known: the prior of the variances (scaled inverse chi squared) stands at scatter of replicates plus floor and is
/// integrated out, which leaves Student's t. A design of less evidence counts as that share of one. The start is the
/// centre of a normal prior as wide as the cube.
class FeaturePosterior {
 public:
  FeaturePosterior(const FitData& data, Point start, const DiscretisationFloor& floor);
  /// The trial whose features the changes refer to; designs that failed there do not count.
  void set_base(const FitTrial& trial);
  /// -log posterior density, constants left out, where the features of design i change by changes[i].
  double operator()(const Point& point, std::span<const FeatureChange> changes) const;
  /// The same where the changes may be wrong by `deviation`, in each design and feature by itself, and the errors that
  /// all designs share (shared_errors.hpp) have the sizes `shared`, which are standard normal; none: no such errors.
  double operator()(const Point& point, std::span<const FeatureChange> changes, double deviation,
                    const Eigen::VectorXd& shared) const;
  Eigen::Index shared_error_count() const { return shared_errors_.cols(); }
  /// What the data leave possible around the base, in unit coordinates: residuals independent. `slopes` as
  /// feature_slopes() gives them.
  Eigen::MatrixXd posterior_covariance(const Eigen::MatrixXd& slopes) const;
  /// One over the variance of every residual, log T then log peak, with the factor that the residuals at the base
  /// suggest; 0 where there is none.
  Eigen::VectorXd learnt_precisions() const;
  /// How far parameters move (rows) to absorb a shared error of normal size (columns).
  Eigen::MatrixXd moves_by_shared_errors(const Eigen::MatrixXd& slopes) const;

 private:
  struct Feature {
    std::vector<double> measured;   ///< log; not a number where there is none
    std::vector<double> variances;  ///< prior
    std::vector<double> base;       ///< log, of the base trial; not a number where it failed
  };
  /// By which the residuals at the base suggest to multiply the prior variances.
  double learnt_factor(const Feature& feature) const;
  Eigen::MatrixXd information(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& precisions) const;

  Point start_;
  std::vector<double> evidence_;  ///< as how many designs each one counts
  Feature toughness_, peak_;
  Eigen::MatrixXd shared_errors_;
};

}  // namespace nacre::sysid
