#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "measurement/measurement.hpp"

namespace nacre::diagnosis {

/// One group of replicate specimens: a design under one set of conditions.
struct Observation {
  pattern::Design design;
  tester::TestConditions conditions;
  double log_modulus = 0.0;  ///< mean of log E over the valid replicates
  int replicates = 0;
  double print_order = 0.0;  ///< mean, 0 when unknown
  std::string batch;         ///< empty when the replicates are of several batches
};

/// Turns differences of log E into uncorrelated ones of unit variance: multiplies by the inverse Cholesky factor of the covariance.
class Whitener {
 public:
  explicit Whitener(const Eigen::MatrixXd& covariance) : factor_(covariance) {}
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& differences) const { return factor_.matrixL().solve(differences); }
  /// The squared length of the whitened vector.
  double chi2(const Eigen::VectorXd& differences) const { return factor_.matrixL().solve(differences).squaredNorm(); }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// The modulus data of a measurement set, groups sorted by design and conditions.
struct Observations {
  std::vector<Observation> groups;
  double replicate_sd = 0.0;        ///< pooled standard deviation of log E of single specimens
  int replicate_dof = 0;            ///< degrees of freedom behind it; 0: no replicates
  double numerics_sd = 0.0;         ///< per layout, of log E, independent between layouts
  Eigen::MatrixXd numerics_shared;  ///< groups x directions: what numerics leave along each, one standard deviation; may be empty
  int size() const { return static_cast<int>(groups.size()); }
  Eigen::VectorXd log_moduli() const;
  /// Covariance of the groups' means when single specimens scatter with `replicate_variance`. What two numerics differ by is the
  /// same for all specimens of one layout: rotated twins share it. Along the shared directions all groups go together.
  Eigen::MatrixXd covariance(double replicate_variance) const;
  Eigen::MatrixXd covariance() const { return covariance(replicate_sd * replicate_sd); }
  /// The part of residuals (measured - predicted log E) that is expected to be numerics along the shared directions, given these
  /// residuals at `rows`; for all groups.
  Eigen::VectorXd shared_numerics(const Eigen::VectorXd& residuals_at_rows, const std::vector<Eigen::Index>& rows) const;
};

/// Groups the valid specimens of layouts that have a modulus; homogeneous coupons are left out.
Observations observe_moduli(const std::vector<measurement::SpecimenRecord>& specimens, double numerics_sd);

}  // namespace nacre::diagnosis
