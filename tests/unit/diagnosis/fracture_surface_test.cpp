#include "diagnosis/fracture_surface.hpp"

#include <gtest/gtest.h>

namespace nacre::diagnosis {
namespace {

Eigen::VectorXd size(double strength) { return Eigen::VectorXd::Constant(1, strength); }

TEST(EffectCovariance, VanishesWithTheEffect) {
  EXPECT_NEAR(effect_covariance(size(0.0), size(0.4), {}), 0.0, 1e-15);
  EXPECT_NEAR(effect_covariance(size(-0.4), size(0.0), {}), 0.0, 1e-15);
}

TEST(EffectCovariance, IsTheSameForBothSignsAndBothOrders) {
  EXPECT_DOUBLE_EQ(effect_covariance(size(-0.3), size(-0.6), {}), effect_covariance(size(0.3), size(0.6), {}));
  EXPECT_DOUBLE_EQ(effect_covariance(size(0.1), size(0.6), {}), effect_covariance(size(0.6), size(0.1), {}));
}

// With effects of either sign the variance once came out below zero, and every emulated feature as no number.
TEST(EffectCovariance, OfSizesOfEitherSignIsACovariance) {
  const std::vector<double> sizes = {-0.6, -0.3, -0.1, 0.1, 0.3, 0.6};
  Eigen::MatrixXd matrix(6, 6);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) matrix(i, j) = effect_covariance(size(sizes[i]), size(sizes[j]), {});
  EXPECT_GT(matrix.diagonal().minCoeff(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff(), 0.0);
}

}  // namespace
}  // namespace nacre::diagnosis
