#include "optimize/ensemble_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nacre::optimize {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> walkers_in(int dimension, int count) {
  RandomStream random(1, "walkers");
  std::vector<VectorXd> walkers;
  for (int k = 0; k < count; ++k) {
    VectorXd walker(dimension);
    for (double& value : walker) value = random.uniform();
    walkers.push_back(walker);
  }
  return walkers;
}

TEST(EnsembleSampler, DrawsALongNarrowNormalDistribution) {
  // Variances 1 and 1e-4 along the diagonals.
  const auto cost = [](const VectorXd& x) {
    const double along = (x[0] + x[1]) / std::sqrt(2.0), across = (x[0] - x[1]) / std::sqrt(2.0);
    return 0.5 * along * along + 0.5 * across * across / 1e-4;
  };
  const auto draws = sample_ensemble(cost, walkers_in(2, 20), 200, 2000, RandomStream(2, "sampler"));
  ASSERT_EQ(draws.size(), 40000u);
  double mean = 0.0, along = 0.0, across = 0.0;
  for (const VectorXd& x : draws) {
    mean += x[0];
    along += std::pow(x[0] + x[1], 2) / 2.0;
    across += std::pow(x[0] - x[1], 2) / 2.0;
  }
  const auto count = static_cast<double>(draws.size());
  EXPECT_NEAR(mean / count, 0.0, 0.08);
  EXPECT_NEAR(along / count, 1.0, 0.12);
  EXPECT_NEAR(across / count, 1e-4, 0.1e-4);
}

TEST(EnsembleSampler, NeverLeavesWhereTheDensityIsPositiveAndFillsItEvenly) {
  const auto cost = [](const VectorXd& x) {
    return x.minCoeff() < 0.0 || x.maxCoeff() > 1.0 ? std::numeric_limits<double>::infinity() : 0.0;
  };
  const auto draws = sample_ensemble(cost, walkers_in(3, 16), 100, 2000, RandomStream(3, "sampler"));
  double low_third = 0.0;
  for (const VectorXd& x : draws) {
    ASSERT_GE(x.minCoeff(), 0.0);
    ASSERT_LE(x.maxCoeff(), 1.0);
    low_third += x[2] < 1.0 / 3.0;
  }
  EXPECT_NEAR(low_third / static_cast<double>(draws.size()), 1.0 / 3.0, 0.03);
}

TEST(EnsembleSampler, EqualSeedsGiveEqualDraws) {
  const auto cost = [](const VectorXd& x) { return 0.5 * x.squaredNorm(); };
  const auto once = sample_ensemble(cost, walkers_in(4, 12), 10, 10, RandomStream(4, "sampler"));
  const auto again = sample_ensemble(cost, walkers_in(4, 12), 10, 10, RandomStream(4, "sampler"));
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i], again[i]);
}

}  // namespace
}  // namespace nacre::optimize
