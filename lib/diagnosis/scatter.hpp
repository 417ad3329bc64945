#pragma once

#include <string>
#include <vector>

#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// One specimen and what its test says.
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

/// Scatter of the replicates of one test, pooled over its groups: what batches have in common counts as history, not as
/// scatter. Correlations are shrunk by p / (p + degrees of freedom), p features. Without replicates 2 % of every
/// logarithm is assumed. With a name of a design, only its groups are pooled.
ReplicateScatter pooled_scatter(const std::vector<std::vector<Measured>>& groups, tester::TestKind test, int batches,
                                const std::string& design = "");

}  // namespace nacre::diagnosis
