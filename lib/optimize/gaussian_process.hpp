#pragma once
// Gaussian-process regression over the unit cube: Matern-5/2 covariance with one length scale per dimension, noise that
// is partly known (replicates, repeatability of a tester) and partly learnt.

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace nacre::optimize {

/// k(x, x') = s^2 (1 + a + a^2 / 3) exp(-a), a^2 = 5 sum_j (x_j - x'_j)^2 / l_j^2; learnt noise s_n^2 on the diagonal.
struct MaternKernel {
  double signal_deviation = 1.0;  ///< s, in the units of the values
  Eigen::VectorXd lengths;        ///< l_j, in units of the cube's edge
  double noise_deviation = 1e-3;  ///< s_n, in the units of the values
  double operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
};

/// Training data: values[i] at inputs.row(i) with an error of known variance noise_variances[i].
struct RegressionData {
  Eigen::MatrixXd inputs;  ///< points x dimensions
  Eigen::VectorXd values;
  Eigen::VectorXd noise_variances;  ///< 0: only the learnt noise
};

/// The posterior for a given kernel. Mean of the prior: the mean of the values. One factorisation, O(n^3), when it is
/// made.
class GaussianProcess {
 public:
  GaussianProcess(RegressionData observations, MaternKernel kernel);

  struct PosteriorValue {
    double mean = 0.0;
    double deviation = 0.0;  ///< of the function itself, without noise
  };
  PosteriorValue predict(const Eigen::VectorXd& at) const;
  /// Rows of `at` are points; one triangular solve for all of them.
  std::vector<PosteriorValue> predict_all(const Eigen::MatrixXd& at) const;
  /// Means alone, without the cost of deviations.
  Eigen::VectorXd means(const Eigen::MatrixXd& at) const;
  Eigen::VectorXd mean_gradient(const Eigen::VectorXd& at) const;
  double log_marginal_likelihood() const;
  /// With respect to log s, log l_1 ... log l_d, log s_n.
  Eigen::VectorXd log_marginal_gradient() const;
  const MaternKernel& kernel() const { return kernel_; }
  const RegressionData& observations() const { return observations_; }
  /// Share of the mean variance that had to be added to the diagonal before the factorisation succeeded; 0 as a rule.
  double jitter() const { return jitter_; }

 private:
  void factorise();
  Eigen::VectorXd covariances(const Eigen::VectorXd& at) const;
  Eigen::MatrixXd covariances_all(const Eigen::MatrixXd& at) const;  ///< observations x points

  RegressionData observations_;
  MaternKernel kernel_;
  Eigen::MatrixXd scaled_;  ///< inputs over lengths
  double mean_ = 0.0;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd weights_;
  double jitter_ = 0.0;
};

/// Kernel of largest posterior density (marginal likelihood times a weak prior that keeps lengths between a twentieth
/// and some twenty edges of the cube), found by L-BFGS on the analytic gradient from a fixed start and `restarts`
/// random ones. Depends on its arguments only. Fewer than three observations, or values that do not vary, give the
/// prior's kernel.
MaternKernel fit_kernel(const RegressionData& observations, int restarts, std::uint64_t seed);

}  // namespace nacre::optimize
