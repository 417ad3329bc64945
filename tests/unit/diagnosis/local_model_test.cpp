#include "diagnosis/local_model.hpp"

#include <gtest/gtest.h>

namespace nacre::diagnosis {
namespace {

/// Two rows over two coordinates, one of which bends.
Eigen::VectorXd bent(const Eigen::VectorXd& u) {
  return Eigen::Vector2d(1.0 + u[0] + 3.0 * u[1] * u[1], 2.0 - u[0] + 0.5 * u[1] - u[1] * u[1]);
}

Eigen::MatrixXd slopes_of_bent(const Eigen::VectorXd& u) {
  Eigen::Matrix2d slopes;
  slopes << 1.0, 6.0 * u[1], -1.0, 0.5 - 2.0 * u[1];
  return slopes;
}

LocalModel about(const Eigen::VectorXd& u, const std::vector<KnownPoint>& past) {
  return {{u, bent(u)}, slopes_of_bent(u), Eigen::Vector2d(1.0, 2.0), past};
}

TEST(LocalModel, IsALineWithoutPastPoints) {
  const Eigen::Vector2d u(0.2, 0.4), other(0.5, -0.1);
  const LocalModel local = about(u, {});
  EXPECT_LT((local.rows(other) - bent(u) - slopes_of_bent(u) * (other - u)).norm(), 1e-12);
  EXPECT_EQ(local.slopes(other), slopes_of_bent(u));
}

TEST(LocalModel, MeetsThePointsItHasPassed) {
  const Eigen::Vector2d u(0.2, 0.4), first(0.9, 0.3), second(0.3, -0.5);
  const LocalModel local = about(u, {{first, bent(first)}, {second, bent(second)}});
  EXPECT_LT((local.rows(first) - bent(first)).norm(), 1e-10);
  EXPECT_LT((local.rows(second) - bent(second)).norm(), 1e-10);
  EXPECT_LT((local.rows(u) - bent(u)).norm(), 1e-12);
}

// Along the coordinate that bends one point tells all of the curvature.
TEST(LocalModel, KnowsABendFromOnePoint) {
  const Eigen::Vector2d u(0.2, 0.4), passed(0.2, -0.5), other(-0.3, 0.9);
  const LocalModel local = about(u, {{passed, bent(passed)}});
  EXPECT_LT((local.rows(other) - bent(other)).norm(), 1e-10);
  EXPECT_LT((local.slopes(other) - slopes_of_bent(other)).norm(), 1e-10);
}

TEST(LocalModel, OfPointsOnOneLineTheLatestCounts) {
  const Eigen::Vector2d u(0.0, 0.0), near(0.0, 0.1), far(0.0, 1.0);
  const std::vector<KnownPoint> past = {{far, Eigen::Vector2d(100.0, 100.0)}, {near, bent(near)}};
  EXPECT_LT((about(u, past).rows(far) - bent(far)).norm(), 1e-10);
}

}  // namespace
}  // namespace nacre::diagnosis
