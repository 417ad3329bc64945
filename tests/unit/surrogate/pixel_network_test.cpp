#include "surrogate/pixel_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::surrogate {
namespace {

/// The whole 20 x 20 unit between two plates, by a dense solver.
double whole_unit_conductance(const pattern::Pattern& pattern, double soft) {
  const auto k = [&](int r, int c) { return pattern.rigid(r, c) ? 1.0 : soft; };
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(400, 400);
  Eigen::VectorXd inflow = Eigen::VectorXd::Zero(400);
  const auto connect = [&](int a, int b, double conductance) {
    laplacian(a, a) += conductance, laplacian(b, b) += conductance;
    laplacian(a, b) -= conductance, laplacian(b, a) -= conductance;
  };
  const auto series = [](double a, double b) { return 1.0 / (0.5 / a + 0.5 / b); };
  for (int r = 0; r < 20; ++r) {
    for (int c = 0; c < 20; ++c) {
      if (c < 19) connect(20 * r + c, 20 * r + c + 1, series(k(r, c), k(r, c + 1)));
      if (r < 19) connect(20 * r + c, 20 * r + c + 20, series(k(r, c), k(r + 1, c)));
      if (r == 0 || r == 19) laplacian(20 * r + c, 20 * r + c) += 2.0 * k(r, c);
      if (r == 0) inflow[c] = 2.0 * k(r, c);
    }
  }
  const Eigen::VectorXd potential = laplacian.ldlt().solve(inflow);
  double current = 0.0;
  for (int c = 0; c < 20; ++c) current += inflow[c] * (1.0 - potential[c]);
  return current;
}

TEST(PixelNetwork, TheQuarterConductsAsTheWholeUnit) {
  RandomStream random(1, "test");
  for (int i = 0; i < 5; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    EXPECT_NEAR(log_conductance(pattern, 0.01), std::log(whole_unit_conductance(pattern, 0.01)), 1e-9);
  }
}

TEST(PixelNetwork, LiesBetweenSoftAndRigidAndGrowsWithEveryRigidPixel) {
  EXPECT_NEAR(log_conductance(pattern::Pattern(pattern::kAllFreePixels), 0.001), 0.0, 1e-12);
  EXPECT_NEAR(log_conductance(pattern::Pattern(0), 0.001), std::log(0.001), 1e-12);
  RandomStream random(2, "test");
  for (int i = 0; i < 20; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    const pattern::Pattern more(pattern.bits() | (std::uint64_t{1} << random.index(pattern::kFreePixels)));
    EXPECT_GE(log_conductance(more, 0.001), log_conductance(pattern, 0.001) - 1e-12);
  }
}

}  // namespace
}  // namespace nacre::surrogate
