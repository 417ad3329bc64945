#pragma once
// Discrepancy model: a Gaussian process that knows no physics, as a stand-in for unmodelled causes.
//
// Residuals ~ N(0, noise + a^2 K), K = s sum_d d d' over the contrast directions (rigid fraction, run lengths, corners,
// rate, order, ...) + (1 - s) same design, scaled to the noise of each kind of row (NameRules::along_contrasts); the
// amplitude a is the most probable one. An effect is named when data drawn from this model would hardly ever let an
// effect lead it by as much as was observed.

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

struct DiscrepancyTest {
  double amplitude = 0.0;  ///< root mean square of the discrepancy, in standard deviations of a row
  double lead = 0.0;  ///< -2 log likelihood of the discrepancy model less chi2 of the named model: above 0 the name
                      ///< is ahead
  double p = 1.0;     ///< chance of such a lead when the discrepancy model is the truth
};

/// Covariance of a discrepancy of amplitude 1: mean diagonal 1 per feature in units of the rows' variances.
Eigen::MatrixXd discrepancy_covariance(const Observations& observations,
                                       const std::vector<ContrastDirection>& directions, const Eigen::MatrixXd& noise,
                                       double along_contrasts);

/// Tests the best model of `count` (1 or 2) effects more than `anchor` has against a discrepancy beside the anchor;
/// `chi2` is that of the fitted effects. Cost: per draw a Cholesky factorisation of the rows, and one of the
/// directions of the discrepancy per amplitude.
DiscrepancyTest tested_against_discrepancy(const Evidence& evidence, const Anchor& anchor, double chi2, int count);

}  // namespace nacre::diagnosis
