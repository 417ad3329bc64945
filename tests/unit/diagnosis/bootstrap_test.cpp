#include "diagnosis/bootstrap.hpp"

#include <gtest/gtest.h>

#include "diagnosis/candidate_effects.hpp"
#include "material/extensions.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

/// Moduli of layouts and pulled coupons, with a direction along which the discretisation moves all moduli.
Observations two_tests() {
  SyntheticSet set;
  set.patterns = 8;
  std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens(set, synthetic_truth());
  for (const auto& coupon : synthetic_coupons(synthetic_truth(), {1e-3, 1e-2}, 5, 0.01, 5)) specimens.push_back(coupon);
  Observations observations = observe(specimens, 0.003, {}, {});
  observations.discretisation_shared = Eigen::MatrixXd::Zero(observations.size(), 1);
  for (int i = 0; i < observations.size(); ++i)
    if (is_modulus_of_layout(observations, i)) observations.discretisation_shared(i, 0) = 0.01 * (1 + i % 3);
  return observations;
}

// Whatever scatter the replicates of a draw suggest, the combinations of rows are independent, and nothing of the rows
// is lost.
TEST(DataSource, CombinationsWeighDataAsTheRowsDo) {
  const Observations observations = two_tests();
  ASSERT_TRUE(observations.has(tester::TestKind::modulus) && observations.has(tester::TestKind::tensile));
  const DataSource source(observations);
  RandomStream random(1, "test/combinations");
  const CovarianceParts parts = observations.covariance_parts();
  ASSERT_GT(observations.scatter.size(), 3u) << "coupons of one material scatter in their own way";
  for (const double spread : {0.0, 0.8, -0.8}) {
    ScatterFactors factors;
    for (std::size_t k = 0; k < observations.scatter.size(); ++k)
      factors.push_back(std::exp(spread * (static_cast<double>(k % 3) - 0.7)));
    Eigen::MatrixXd covariance = parts.fixed;
    for (int i = 0; i < observations.size(); ++i)
      for (int j = 0; j < observations.size(); ++j)
        covariance(i, j) += factors[observations.rows[i].scatter] * parts.scatter(i, j);
    Eigen::VectorXd y(observations.size());
    for (double& value : y) value = 0.05 * random.normal();
    const double by_rows = Whitener(covariance).chi2(y);
    const double combined =
        Whitener::independent(source.variances(factors).cwiseSqrt()).chi2(source.combined(Eigen::MatrixXd(y)));
    EXPECT_NEAR(combined, by_rows, 1e-6 * by_rows);
  }
}

TEST(DataSource, DrawsScatterAsTheVariancesOfADrawSayOnAverage) {
  const Observations observations = two_tests();
  const DataSource source(observations);
  const Eigen::VectorXd truth = Eigen::VectorXd::Constant(observations.size(), 2.0);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(observations.size());
  double weight = 0.0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(2, "test/draw/" + std::to_string(i));
    const NoisyData data = source.draw(truth, random);
    squares += (data.values - truth).cwiseAbs2() / kDraws;
    weight += data.whitener.chi2(data.values - truth) / observations.size() / kDraws;
  }
  EXPECT_NEAR(squares.mean(), 1.0, 0.02);
  // A draw weighs its data by the scatter that its own replicates suggest: more than one per row, as Fisher's F has n /
  // (n - 2) with n degrees of freedom.
  EXPECT_GT(weight, 1.05);
  EXPECT_LT(weight, 1.6);
  EXPECT_LT((squares.array() - 1.0).abs().maxCoeff(), 0.15);  // sd of one entry 0.022
}

/// Sums of squares of 25 and of 50 residuals of unit variance.
DrawStatistics drawn(RandomStream& random) {
  DrawStatistics draw;
  draw.parts = {0.0, 0.0};
  for (int i = 0; i < 75; ++i) draw.parts[i < 25 ? 0 : 1] += std::pow(random.normal(), 2);
  draw.chi2 = draw.parts[0] + draw.parts[1];
  return draw;
}

std::vector<DrawStatistics> drawn(int count, RandomStream& random) {
  std::vector<DrawStatistics> draws;
  for (int i = 0; i < count; ++i) draws.push_back(drawn(random));
  return draws;
}

TEST(OmnibusChance, APartThatScattersLessDoesNotHideTheOther) {
  RandomStream random(1, "omnibus");
  const std::vector<DrawStatistics> draws = drawn(2000, random);
  DrawStatistics observed;
  observed.parts = {65.0, 15.0};  // residuals of 1.6 and of 0.5
  observed.chi2 = 80.0;
  EXPECT_LT(omnibus_chance(draws, observed), 0.002);
  observed.parts = {25.0, 15.0};
  observed.chi2 = 40.0;
  EXPECT_GT(omnibus_chance(draws, observed), 0.3);
}

TEST(OmnibusChance, IsAChance) {
  RandomStream random(2, "omnibus");
  const std::vector<DrawStatistics> draws = drawn(2000, random), data = drawn(600, random);
  for (const double level : {0.01, 0.05, 0.2}) {
    const auto below =
        std::ranges::count_if(data, [&](const DrawStatistics& each) { return omnibus_chance(draws, each) <= level; });
    EXPECT_NEAR(static_cast<double>(below) / 600.0, level, 3.0 * std::sqrt(level / 600.0));
  }
}

TEST(Bootstrap, WhatIsBeyondAThresholdIsRareEnoughAndNothingElse) {
  for (const int count : {700, 999, 2000}) {
    std::vector<double> draws;
    for (int i = 0; i < count; ++i) draws.push_back((i * 7919) % count);
    for (const double level : {0.003, 0.01, 0.05}) {
      const double limit = threshold(draws, level);
      EXPECT_LE(exceedance(draws, limit + 0.5), level);
      EXPECT_GT(exceedance(draws, limit), level);
    }
  }
}

}  // namespace
}  // namespace nacre::diagnosis
