#include "sysid/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre::sysid {
namespace {

TEST(ParameterDeviations, FallWithTheRootOfTheData) {
  const auto deviation = [](int count) {
    Eigen::VectorXd residuals(count);
    for (int i = 0; i < count; ++i) residuals[i] = i % 2 == 0 ? 0.1 : -0.1;
    return parameter_deviations(Eigen::MatrixXd::Ones(count, 1), residuals, Eigen::VectorXd::Ones(count), 0.01).front();
  };
  EXPECT_NEAR(deviation(100) / deviation(400), 2.0, 0.02);
  EXPECT_NEAR(deviation(100), 0.01, 1e-4);
}

TEST(ParameterDeviations, WithoutEffectAreThoseOfTheRange) {
  const auto deviations =
      parameter_deviations(Eigen::MatrixXd::Zero(10, 1), Eigen::VectorXd::Ones(10), Eigen::VectorXd::Ones(10), 0.01);
  EXPECT_NEAR(deviations.front(), kUnknownDeviation, 1e-12);
}

TEST(ParameterDeviations, AnErrorThatAllResidualsShareIsNotAveragedAway) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(1000);
  const Eigen::MatrixXd shared = 0.06 * ones;
  const auto deviations = parameter_deviations(Eigen::MatrixXd(2.0 * ones), 1e-3 * ones, ones, 0.001, shared);
  EXPECT_NEAR(deviations.front(), 0.03, 1e-4);
}

// The error looks like what the second parameter does: the first one does not take it over.
TEST(ParameterDeviations, ASharedErrorFallsOnTheParameterThatLooksLikeIt) {
  const int count = 200;
  Eigen::MatrixXd jacobian(count, 2);
  Eigen::VectorXd trend(count);
  for (int i = 0; i < count; ++i) trend[i] = i % 2 == 0 ? 1.0 : -1.0;
  jacobian.col(0).setOnes();
  jacobian.col(1) = trend;
  const Eigen::VectorXd residuals = Eigen::VectorXd::Constant(count, 1e-3), weights = Eigen::VectorXd::Ones(count);
  const auto deviations = parameter_deviations(jacobian, residuals, weights, 1e-3, 0.05 * trend);
  EXPECT_NEAR(deviations[1], 0.05, 1e-3);
  EXPECT_LT(deviations[0], 1e-3);
}

}  // namespace
}  // namespace nacre::sysid
