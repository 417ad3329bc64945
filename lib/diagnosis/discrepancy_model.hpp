#pragma once
// The rival that no library names: a cause that goes with what is to be seen of the specimens, in a way that nobody
// wrote down.
//
// Its residuals are a Gaussian field over the rows: half of the variance along the contrast directions (rigid fraction,
// run lengths, corners, rate, order, ...), half of each design's own; its amplitude is the most probable one. An effect
// is named when data of that rival would hardly ever let an effect lead it by as much as was seen.

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// The share of such data sets that may give a name (the aim of the blind trials: a wrong name in at most 3 % of causes
/// outside the library).
inline constexpr double kDiscrepancyLevel = 0.03;

struct DiscrepancyTest {
  double amplitude = 0.0;  ///< root mean square of what it adds, in standard deviations of a row
  double lead = 0.0;  ///< -2 log likelihood of the outsider less chi2 of the named model: above 0 the name is ahead
  double p = 1.0;     ///< chance of such a lead when the outsider is the truth
};

/// Covariance of what an outsider of amplitude 1 adds: mean diagonal 1 per feature in units of the rows' variances.
Eigen::MatrixXd discrepancy_covariance(const Observations& observations,
                                       const std::vector<ContrastDirection>& directions, const Eigen::MatrixXd& noise);

/// Holds the best model of `count` (1 or 2) effects against the outsider; `chi2` is that model's, fitted. Cost: a
/// Cholesky factorisation of the rows per amplitude and draw.
DiscrepancyTest tested_against_discrepancy(const Evidence& evidence, double chi2, int count);

}  // namespace nacre::diagnosis
