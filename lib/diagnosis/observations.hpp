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

/// The modulus data of a measurement set, groups sorted by design and conditions.
struct Observations {
  std::vector<Observation> groups;
  double replicate_sd = 0.0;        ///< pooled standard deviation of log E of single specimens
  int replicate_dof = 0;            ///< degrees of freedom behind it; 0: no replicates
  double numerics_sd = 0.0;         ///< per layout, of log E
  int size() const { return static_cast<int>(groups.size()); }
  Eigen::VectorXd log_moduli() const;
  /// Variance of each group's mean when single specimens scatter with `replicate_variance`.
  Eigen::VectorXd variances(double replicate_variance) const;
  Eigen::VectorXd variances() const { return variances(replicate_sd * replicate_sd); }
};

/// Groups the valid specimens that have a modulus.
Observations observe_moduli(const std::vector<measurement::SpecimenRecord>& specimens, double numerics_sd);

}  // namespace nacre::diagnosis
