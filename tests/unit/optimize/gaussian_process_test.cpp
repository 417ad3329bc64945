#include "optimize/gaussian_process.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "optimize/rivals/acquisition.hpp"

namespace nacre::optimize {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd vec(std::initializer_list<double> values) {
  VectorXd result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

MaternKernel kernel(double signal, VectorXd lengths, double noise) { return {signal, std::move(lengths), noise}; }

RegressionData random_observations(int count, int dimension, double noise_variance = 0.0) {
  RandomStream random(3, "gp");
  RegressionData data{MatrixXd(count, dimension), VectorXd(count), VectorXd::Constant(count, noise_variance)};
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < dimension; ++j) data.inputs(i, j) = random.uniform();
    data.values[i] = std::sin(4.0 * data.inputs(i, 0)) + 0.1 * random.normal();
  }
  return data;
}

TEST(MaternKernel, HasItsClosedForm) {
  const MaternKernel k = kernel(2.0, vec({0.5, 1e6}), 0.0);
  const double a = std::sqrt(5.0) * 0.3 / 0.5;
  EXPECT_NEAR(k(vec({0.1, 0.2}), vec({0.4, 0.9})), 4.0 * (1 + a + a * a / 3) * std::exp(-a), 1e-9);
  EXPECT_DOUBLE_EQ(k(vec({0.1, 0.2}), vec({0.1, 0.2})), 4.0);
}

// One observation y besides the prior mean m (here the mean of the values, y itself, so two points are needed for a
// closed form).
TEST(GaussianProcess, TwoObservationsHaveTheirClosedForm) {
  RegressionData data{MatrixXd(2, 1), vec({1.0, 3.0}), vec({0.04, 0.09})};
  data.inputs << 0.2, 0.6;
  const MaternKernel k = kernel(1.5, vec({0.4}), 0.1);
  const GaussianProcess process(data, k);
  const double c = k(vec({0.2}), vec({0.6})), p = 2.25 + 0.01 + 0.04, q = 2.25 + 0.01 + 0.09, det = p * q - c * c;
  const double ka = k(vec({0.5}), vec({0.2})), kb = k(vec({0.5}), vec({0.6}));
  // Weights K^-1 (y - 2) with y - 2 = (-1, 1).
  const double wa = (-q - c) / det, wb = (p + c) / det;
  const auto predicted = process.predict(vec({0.5}));
  EXPECT_NEAR(predicted.mean, 2.0 + ka * wa + kb * wb, 1e-12);
  const double explained = (q * ka * ka - 2 * c * ka * kb + p * kb * kb) / det;
  EXPECT_NEAR(predicted.deviation, std::sqrt(2.25 - explained), 1e-12);
  const double quadratic = (q + 2 * c + p) / det;
  EXPECT_NEAR(process.log_marginal_likelihood(),
              -0.5 * quadratic - 0.5 * std::log(det) - std::log(2 * std::numbers::pi), 1e-12);
}

TEST(GaussianProcess, InterpolatesWhereThereIsNoNoise) {
  const RegressionData data = random_observations(12, 2);
  const GaussianProcess process(data, kernel(1.0, vec({0.4, 0.6}), 0.0));
  for (Eigen::Index i = 0; i < 12; ++i) {
    const auto predicted = process.predict(data.inputs.row(i).transpose());
    EXPECT_NEAR(predicted.mean, data.values[i], 1e-8);
    EXPECT_NEAR(predicted.deviation, 0.0, 1e-6);
  }
}

TEST(GaussianProcess, ANoisierObservationIsBelievedLess) {
  RegressionData data{MatrixXd(2, 1), vec({0.0, 1.0}), vec({0.0, 0.0})};
  data.inputs << 0.3, 0.7;
  const MaternKernel k = kernel(1.0, vec({0.3}), 0.0);
  const double exact = GaussianProcess(data, k).predict(vec({0.7})).mean;
  data.noise_variances[1] = 1.0;
  EXPECT_LT(GaussianProcess(data, k).predict(vec({0.7})).mean, 0.8 * exact);
}

TEST(GaussianProcess, ManyPointsAtOnceEqualOneByOne) {
  const RegressionData data = random_observations(20, 3);
  const GaussianProcess process(data, kernel(1.0, vec({0.4, 0.6, 0.9}), 0.1));
  const MatrixXd at = random_observations(7, 3).inputs;
  const auto all = process.predict_all(at);
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    const auto one = process.predict(at.row(i).transpose());
    EXPECT_NEAR(all[i].mean, one.mean, 1e-12);
    EXPECT_NEAR(all[i].deviation, one.deviation, 1e-10);
  }
}

TEST(GaussianProcess, LikelihoodGradientIsThatOfFiniteDifferences) {
  const RegressionData data = random_observations(15, 3, 0.01);
  const MaternKernel at = kernel(0.8, vec({0.5, 0.9, 1.3}), 0.15);
  const VectorXd gradient = GaussianProcess(data, at).log_marginal_gradient();
  ASSERT_EQ(gradient.size(), 5);
  for (Eigen::Index k = 0; k < 5; ++k) {
    const auto moved = [&](double by) {
      MaternKernel other = at;
      if (k == 0) other.signal_deviation *= std::exp(by);
      if (k > 0 && k < 4) other.lengths[k - 1] *= std::exp(by);
      if (k == 4) other.noise_deviation *= std::exp(by);
      return GaussianProcess(data, other).log_marginal_likelihood();
    };
    EXPECT_NEAR(gradient[k], (moved(1e-5) - moved(-1e-5)) / 2e-5, 1e-5 * (1 + std::abs(gradient[k]))) << k;
  }
}

TEST(GaussianProcess, MeanGradientIsThatOfFiniteDifferences) {
  const GaussianProcess process(random_observations(15, 2), kernel(0.8, vec({0.5, 0.9}), 0.1));
  const VectorXd at = vec({0.37, 0.81}), gradient = process.mean_gradient(at);
  for (Eigen::Index j = 0; j < 2; ++j) {
    VectorXd up = at, down = at;
    up[j] += 1e-5;
    down[j] -= 1e-5;
    EXPECT_NEAR(gradient[j], (process.predict(up).mean - process.predict(down).mean) / 2e-5, 1e-6);
  }
}

TEST(GaussianProcess, RepeatedPointsWithoutNoiseNeedJitterAndSaySo) {
  RegressionData data{MatrixXd::Constant(6, 2, 0.5), vec({1, 1, 1, 1, 1, 1}), VectorXd::Zero(6)};
  const GaussianProcess process(data, kernel(1.0, vec({0.5, 0.5}), 0.0));
  EXPECT_GT(process.jitter(), 0.0);
  EXPECT_LT(process.jitter(), 1e-6);
  EXPECT_TRUE(std::isfinite(process.predict(vec({0.2, 0.2})).mean));
}

TEST(KernelFit, FindsTheDimensionThatMattersAndTheNoise) {
  const RegressionData data = random_observations(60, 3);
  const MaternKernel fitted = fit_kernel(data, 1, 1);
  EXPECT_LT(fitted.lengths[0], 1.0);
  EXPECT_GT(fitted.lengths[1], 2.0 * fitted.lengths[0]);
  EXPECT_GT(fitted.lengths[2], 2.0 * fitted.lengths[0]);
  EXPECT_NEAR(fitted.noise_deviation, 0.1, 0.05);
}

TEST(KernelFit, ScalesWithTheValues) {
  RegressionData data = random_observations(25, 2);
  const MaternKernel fitted = fit_kernel(data, 0, 1);
  data.values *= 1e6;
  const MaternKernel scaled = fit_kernel(data, 0, 1);
  EXPECT_NEAR(scaled.signal_deviation, 1e6 * fitted.signal_deviation, 1e-3 * scaled.signal_deviation);
  EXPECT_NEAR(scaled.lengths[0], fitted.lengths[0], 1e-3 * fitted.lengths[0]);
}

TEST(ExpectedImprovement, HasItsClosedFormAndANumericallySafeTail) {
  for (const double z : {-3.0, -0.5, 0.0, 2.0}) {
    double sum = 0.0;  // E max(0, z + N) by the midpoint rule
    for (int i = 0; i < 400000; ++i) {
      const double t = -10.0 + 20.0 * (i + 0.5) / 400000;
      sum += std::max(0.0, z + t) * std::exp(-0.5 * t * t) / std::sqrt(2 * std::numbers::pi) * (20.0 / 400000);
    }
    EXPECT_NEAR(log_expected_improvement(z), std::log(sum), 1e-6) << z;
  }
  EXPECT_NEAR(log_expected_improvement(-9.999), log_expected_improvement(-10.001), 0.05);
  EXPECT_NEAR(log_expected_improvement(-10.0 - 1e-9), log_expected_improvement(-10.0 + 1e-9), 1e-5);
  EXPECT_NEAR(log_expected_improvement(-100.0), -5000.0 - 0.5 * std::log(2 * std::numbers::pi) - 2 * std::log(100.0),
              1e-3);
  EXPECT_NEAR(log_normal_cdf(-10.0 - 1e-9), log_normal_cdf(-10.0 + 1e-9), 1e-6);
}

TEST(PenalisedImprovement, IsNothingAtAPendingPointAndWholeFarFromIt) {
  RegressionData data{MatrixXd(3, 1), vec({1.0, 0.0, 1.0}), VectorXd::Zero(3)};
  data.inputs << 0.1, 0.5, 0.9;
  const GaussianProcess process(data, kernel(1.0, vec({0.2}), 0.0));
  PenalisedImprovement worth(process, 0.0, 0.01, 1);
  const double before = worth(vec({0.42})), far = worth(vec({0.99}));
  worth.add_pending(vec({0.42}));
  EXPECT_LT(worth(vec({0.42})), before - 0.5);
  EXPECT_NEAR(worth(vec({0.99})), far, 0.05);
}

}  // namespace
}  // namespace nacre::optimize
