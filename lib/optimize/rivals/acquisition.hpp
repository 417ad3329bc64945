#pragma once
// The acquisition function of Bayesian optimisation.

#include <vector>

#include "optimize/gaussian_process.hpp"

namespace nacre::optimize {

/// log E[max(0, z + N(0, 1))] = log(phi(z) + z Phi(z)), accurate far into the left tail, where the expectation itself
/// underflows.
double log_expected_improvement(double z);
/// log Phi(z), accurate in the left tail.
double log_normal_cdf(double z);

/// Expected improvement below `incumbent`, times a local penalty around every point that is being evaluated already
/// (Gonzalez, Dai, Hennig, Lawrence, AISTATS 2016, with sigma in place of the square root of sigma that a widespread
/// implementation takes).
class PenalisedImprovement {
 public:
  /// `margin`: how much below the incumbent improvement begins, in signal deviations of the process (0.01 is usual).
  PenalisedImprovement(const GaussianProcess& process, double incumbent, double margin, std::uint64_t seed);
  void add_pending(const Eigen::VectorXd& at);
  /// Logarithm of the penalised expected improvement.
  double operator()(const Eigen::VectorXd& at) const;
  double operator()(const Eigen::VectorXd& at, const GaussianProcess::PosteriorValue& predicted) const;

 private:
  struct Pending {
    Eigen::VectorXd at;
    GaussianProcess::PosteriorValue predicted;
  };
  const GaussianProcess& process_;
  double threshold_, smallest_, lipschitz_;
  std::vector<Pending> pending_;
};

}  // namespace nacre::optimize
