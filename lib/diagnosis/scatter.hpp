#pragma once
// Scatter of replicates: pooled covariance of deviations from group means, correlations shrunk by p / (p + dof).

#include <string>
#include <vector>

#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// One specimen and the features of its test.
struct Measured {
  const measurement::SpecimenRecord* specimen = nullptr;
  FeatureValues features;
  double batch_step = 0.0;  ///< number of its batch in the order of names, the first is 0
};

/// Deviation of every replicate from the mean of its group, where each of the group has the feature.
struct Deviation {
  const Measured* measured = nullptr;
  int group = 0;
  FeatureValues from_mean;
};
std::vector<Deviation> deviations_of(const std::vector<std::vector<Measured>>& groups, tester::TestKind test);

/// Relative scatter of single specimens where there are no replicates.
struct AssumedScatter {
  double modulus = 0.02, stress = 0.05, strain = 0.01, toe_strain = 2e-4;
};

/// Covariance between the features of one specimen. Its stresses are correlated: a thicker print is stiffer from the
/// first strain to the last.
Eigen::MatrixXd covariance_of(const AssumedScatter& scatter, const NoiseRules& rules);

/// Scatter of the replicates of one test, pooled over its groups: differences between batches count as history, not as
/// scatter. Correlations are shrunk by p / (p + degrees of freedom), p features. Without replicates 2 % of everything
/// is assumed, or how moduli lie off lines over the logarithm of the rate where that is more; and so it is for features
/// that only some of the groups show, as far as the others lack them. Few replicates that agree better than that are
/// not believed: up to eight degrees of freedom are made up with it. With a name of a design, only its groups are
/// pooled.
ReplicateScatter pooled_scatter(const std::vector<std::vector<Measured>>& groups, tester::TestKind test,
                                const NoiseRules& rules, const std::string& design = "");

/// Whether the homogeneous materials of modulus tests scatter differently beyond chance (Bartlett 1937).
bool materials_scatter_differently(const std::vector<std::vector<Measured>>& groups, const NoiseRules& rules);

/// Scatter of every test, and of each material's coupons where their replicates determine it; of its moduli where
/// materials scatter differently. Beside layouts notched homogeneous specimens, whose cracks have one way to go,
/// scatter for themselves.
void put_scatter(Observations& observations, const std::vector<std::vector<Measured>>& groups, const NoiseRules& rules);

/// 95 % quantile of Student's t over the normal one (Abramowitz and Stegun 26.7.5; within 0.3 % from 2 degrees of
/// freedom on). Without replicates: a little.
double student(int dof);

/// Degrees of freedom behind the scatter of those rows that show most of a change.
int dof_behind(const Observations& observations, const Eigen::VectorXd& change);

/// Number of sets of batches that no group joins. Where there are several, differences between batches look like
/// differences between designs. Specimens without a batch do not count.
int disconnected_batches(const std::vector<std::vector<Measured>>& groups);

}  // namespace nacre::diagnosis
