#include "diagnosis/bounded_least_squares.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace nacre::diagnosis {
namespace {

TEST(BoundedLeastSquares, WithinItsBoundsIsTheUsualSolution) {
  Eigen::MatrixXd a(3, 2);
  a << 1, 2, 0, 1, 3, 1;
  const Eigen::Vector3d b(1, 2, 3);
  const BoundedSolution solved =
      bounded_least_squares(a, b, Eigen::VectorXd::Constant(2, -10.0), Eigen::VectorXd::Constant(2, 10.0));
  const Eigen::VectorXd usual = a.householderQr().solve(b);
  EXPECT_LT((solved.x - usual).norm(), 1e-12);
  EXPECT_NEAR(solved.rest, (b - a * usual).squaredNorm(), 1e-12);
}

// The usual solution is (4, -2); cut to the bounds it would be (1, -2).
TEST(BoundedLeastSquares, WhatIsAtItsBoundMovesTheOthers) {
  Eigen::MatrixXd a(2, 2);
  a << 1, 1, 1, 2;
  const Eigen::Vector2d b(2, 0);
  const Eigen::Vector2d low(-1, -5), high(1, 5);
  const BoundedSolution solved = bounded_least_squares(a, b, low, high);
  EXPECT_EQ(solved.x[0], 1.0);
  EXPECT_NEAR(solved.x[1], -0.2, 1e-12);  // min (1 - x2)^2 + (-1 - 2 x2)^2
  EXPECT_NEAR(solved.rest, 1.44 + 0.36, 1e-12);
}

// No change of one unknown, nor of the open ones, lowers the sum: the conditions of the optimum, over many problems.
TEST(BoundedLeastSquares, IsTheOptimum) {
  std::srand(7);
  constexpr int kRows = 8, kUnknowns = 5;
  for (int trial = 0; trial < 300; ++trial) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Random(kRows, kUnknowns);
    a.col(1) = a.col(0) + 0.01 * a.col(1);  // nearly alike
    const Eigen::VectorXd b = 3.0 * Eigen::VectorXd::Random(kRows);
    const Eigen::VectorXd low = -Eigen::VectorXd::Random(kUnknowns).cwiseAbs(),
                          high = Eigen::VectorXd::Random(kUnknowns).cwiseAbs();
    const BoundedSolution solved = bounded_least_squares(a, b, low, high);
    const Eigen::VectorXd descent = a.transpose() * (b - a * solved.x);
    for (int i = 0; i < kUnknowns; ++i) {
      EXPECT_GE(solved.x[i], low[i] - 1e-8);
      EXPECT_LE(solved.x[i], high[i] + 1e-8);
      if (solved.x[i] > low[i] + 1e-8) EXPECT_GT(descent[i], -1e-6);
      if (solved.x[i] < high[i] - 1e-8) EXPECT_LT(descent[i], 1e-6);
    }
  }
}

TEST(BoundedLeastSquares, AColumnOfNothingStays) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2, 2);
  a.col(0) << 1, 1;
  const BoundedSolution solved = bounded_least_squares(a, Eigen::Vector2d(1, 1), Eigen::VectorXd::Constant(2, -1.0),
                                                       Eigen::VectorXd::Constant(2, 1.0));
  EXPECT_NEAR(solved.x[0], 1.0, 1e-12);
  EXPECT_TRUE(solved.x.allFinite());
}

}  // namespace
}  // namespace nacre::diagnosis
