#include "sysid/likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "sysid/discretisation_floor.hpp"
#include "sysid/feature_posterior.hpp"
#include "sysid/features.hpp"

namespace nacre::sysid {
namespace {

using measurement::Replicates;

Replicates measured_modulus(double mean_pa, double sd_pa, int count) {
  Replicates design;
  design.modulus_count = count;
  design.modulus_pa = mean_pa;
  design.modulus_sd_pa = sd_pa;
  return design;
}

Prediction modulus(double value_pa) {
  Prediction prediction;
  prediction.modulus_pa = value_pa;
  return prediction;
}

TEST(RelativeScatter, IsPooledByDegreesOfFreedom) {
  const std::vector<Replicates> measured = {measured_modulus(1e9, 2e7, 3), measured_modulus(2e9, 2e7, 5),
                                            measured_modulus(1e9, 0.0, 1)};
  EXPECT_NEAR(pooled_relative_scatter(measured).log_modulus, std::sqrt((2 * 4e-4 + 4 * 1e-4) / 6), 1e-12);
}

TEST(RelativeScatter, IsTheDeclaredOneWithoutReplicates) {
  EXPECT_EQ(pooled_relative_scatter({measured_modulus(1e9, 0.0, 1)}, {0.03, 0.2}).log_modulus, 0.03);
}

TEST(Likelihood, CountsSquaredResidualsOverScatterAndFloor) {
  const std::vector<Replicates> measured = {measured_modulus(1e9, 2e7, 4), measured_modulus(1e9, 2e7, 4)};
  DiscretisationFloor floor = DiscretisationFloor::none();
  floor.log_modulus_sd = 0.03;
  const double e = std::exp(0.05) * 1e9, variance = 1e-4 + 9e-4;
  const Likelihood likelihood = modulus_likelihood_of(measured, {modulus(e), modulus(1e9)}, floor, 1);
  EXPECT_EQ(likelihood.fit.count, 2);
  EXPECT_EQ(likelihood.fit.freedom, 1);
  EXPECT_NEAR(likelihood.fit.chi_squared, 25e-4 / variance, 1e-9);
  EXPECT_NEAR(likelihood.fit.chi_squared_replicates, 25.0, 1e-9);
  EXPECT_NEAR(likelihood.deviance, 25e-4 / variance + 2 * std::log(variance), 1e-9);
}

TEST(Likelihood, KnowsWhatTheFloorShiftsInAllDesignsAtOnce) {
  const std::vector<Replicates> measured(2, measured_modulus(1e9, 2e7, 4));
  DiscretisationFloor floor = DiscretisationFloor::none();
  floor.log_modulus_common_sd = 0.05;
  const auto likelihood = [&](double first, double second) {
    return modulus_likelihood_of(measured, {modulus(1e9 * std::exp(first)), modulus(1e9 * std::exp(second))}, floor, 0);
  };
  // Covariance a on the diagonal and c beside it: eigenvalues a + c of the common part, a - c of the difference.
  const double replicates = 1e-4, a = replicates + 25e-4, c = 25e-4, r = 0.05;
  EXPECT_NEAR(likelihood(r, r).fit.chi_squared, 2 * r * r / (a + c), 1e-9);
  EXPECT_NEAR(likelihood(r, -r).fit.chi_squared, 2 * r * r / replicates, 1e-9);
  EXPECT_NEAR(likelihood(r, r).deviance, 2 * r * r / (a + c) + std::log((a + c) * (a - c)), 1e-9);
  EXPECT_FALSE(likelihood(r, r).fit.misfit());
  EXPECT_TRUE(likelihood(r, -r).fit.misfit());
}

TEST(GoodnessOfFit, CallsNoMisfitWhereNothingWasFittedAndTheFloorExplainsAll) {
  RandomStream random(7, "floor");
  DiscretisationFloor floor = DiscretisationFloor::none();
  floor.log_modulus_sd = 0.005;
  floor.log_modulus_common_sd = 0.05;
  floor.log_toughness_sd = 0.2;
  floor.log_toughness_common_sd = 0.3;
  int of_modulus = 0, of_toughness = 0;
  for (int set = 0; set < 400; ++set) {
    const double modulus_shift = 0.05 * random.normal(), toughness_shift = 0.3 * random.normal();
    std::vector<Replicates> measured;
    std::vector<Prediction> predictions;
    for (int i = 0; i < 12; ++i) {
      measured.push_back(measured_modulus(1e9 * std::exp(0.005 * random.normal() + modulus_shift), 1e5, 4));
      measured.back().toughness_count = 4;
      measured.back().toughness_pa = 2e5 * std::exp(0.2 * random.normal() + toughness_shift);
      measured.back().toughness_sd_pa = 1e2;
      predictions.push_back(modulus(1e9));
      predictions.back().toughness_pa = 2e5;
    }
    of_modulus += modulus_likelihood_of(measured, predictions, floor, 0).fit.misfit();
    of_toughness += toughness_likelihood_of(measured, predictions, floor, 0).fit.misfit();
  }
  EXPECT_LE(of_modulus, 10);
  EXPECT_LE(of_toughness, 10);
}

TEST(Likelihood, TestsNothingWhereTheFitLeavesLessThanOneDegreeOfFreedom) {
  const std::vector<Replicates> measured(3, measured_modulus(1e9, 1e7, 4));
  const std::vector<Prediction> wrong(3, modulus(1.2e9));
  const GoodnessOfFit tested = modulus_likelihood_of(measured, wrong, {}, 1.9).fit;
  EXPECT_EQ(tested.freedom, 1);
  EXPECT_TRUE(tested.misfit());
  const GoodnessOfFit untested = modulus_likelihood_of(measured, wrong, {}, 2.1).fit;
  EXPECT_FALSE(untested.tested());
  EXPECT_FALSE(untested.misfit());
  EXPECT_DOUBLE_EQ(untested.chi_squared, tested.chi_squared);
}

TEST(Likelihood, StaysFiniteWhereReplicatesAgreeExactly) {
  const Likelihood likelihood = modulus_likelihood_of({measured_modulus(1e9, 0.0, 4)}, {modulus(2e9)},
                                                      DiscretisationFloor{.log_modulus_sd = 0.0}, 0);
  EXPECT_TRUE(std::isfinite(likelihood.fit.chi_squared));
  EXPECT_TRUE(std::isfinite(likelihood.fit.chi_squared_replicates));
  EXPECT_TRUE(likelihood.fit.misfit());
}

TEST(Likelihood, HasTheTailOfF) {
  // Quantiles of the tables: 5 % and 1 % points.
  constexpr double kMany = 1e6;  // chi squared over its degrees of freedom
  EXPECT_NEAR(f_tail(3.841, 1, kMany), 0.05, 0.005);
  EXPECT_NEAR(f_tail(1.8307, 10, kMany), 0.05, 0.001);
  EXPECT_NEAR(f_tail(2.3209, 10, kMany), 0.01, 0.001);
  EXPECT_NEAR(f_tail(2.978, 10, 10), 0.05, 0.002);
  EXPECT_NEAR(f_tail(4.849, 10, 10), 0.01, 0.001);
  EXPECT_GT(f_tail(27.23, 10, 3), 0.01) << "with few degrees below too large";
  EXPECT_LT(f_tail(27.23, 10, 3), 0.02);
}

// Designs of one truth whose replicates scatter by 2 %; a misfit is called at 1 %.
TEST(GoodnessOfFit, CallsFewMisfitsHoweverLittleIsKnownOfTheScatter) {
  RandomStream random(5, "scatter");
  constexpr int kDesigns = 12, kSets = 400;
  for (const int replicated : {0, 1, 3, kDesigns}) {
    int misfits = 0;
    for (int set = 0; set < kSets; ++set) {
      std::vector<Replicates> measured;
      for (int i = 0; i < kDesigns; ++i) {
        const double a = 1e9 * (1.0 + 0.02 * random.normal()), b = 1e9 * (1.0 + 0.02 * random.normal());
        measured.push_back(i < replicated ? measured_modulus(0.5 * (a + b), std::abs(a - b) / std::sqrt(2.0), 2)
                                          : measured_modulus(a, 0.0, 1));
      }
      const std::vector<Prediction> truth(kDesigns, modulus(1e9));
      misfits += modulus_likelihood_of(measured, truth, DiscretisationFloor::none(), 0).fit.misfit();
    }
    EXPECT_LE(misfits, kSets / 40) << replicated << " designs with replicates";
  }
}

TEST(GoodnessOfFit, CallsResidualsOfTheSizeOfScatterNoMisfitAndLargerOnesOne) {
  RandomStream random(1, "fit");
  std::vector<Replicates> measured;
  std::vector<Prediction> right, wrong;
  for (int i = 0; i < 18; ++i) {
    measured.push_back(measured_modulus(1e9, 1e7, 4));
    right.push_back(modulus(1e9 * std::exp(0.005 * random.normal())));
    wrong.push_back(modulus(1e9 * std::exp(0.03 * random.normal())));
  }
  EXPECT_FALSE(modulus_likelihood_of(measured, right, {}, 4).fit.misfit());
  EXPECT_TRUE(modulus_likelihood_of(measured, wrong, {}, 4).fit.misfit());
}

TEST(DiscretisationFloor, IsReadFromTheTableOfItsFidelity) {
  const auto file = std::filesystem::path(testing::TempDir()) / "floor.toml";
  write_file_atomically(file,
                        "[tiny]\nlog_modulus_mean = -0.05\nlog_toughness_sd = 0.3\n"
                        "covariance_rigid = [[1e-6, 0, 0], [0, 0.04, 0], [0, 0, 0.01]]\n"
                        "log_eta_sd = {w_vw_j_per_m3 = 0.6, gamma_per_s = 1.7}\n");
  const DiscretisationFloor floor = read_discretisation_floor(file, tester::Fidelity::tiny);
  EXPECT_EQ(floor.log_modulus_common_sd, 0.05);
  EXPECT_EQ(floor.log_toughness_sd, 0.3);
  EXPECT_EQ(floor.log_modulus_sd, DiscretisationFloor{}.log_modulus_sd);
  EXPECT_DOUBLE_EQ(floor.log_toughness_trend_sd, 0.2);
  EXPECT_DOUBLE_EQ(floor.log_peak_trend_sd, 0.1);
  EXPECT_EQ(floor.log_eta_sd, (material::ToughnessVector{0, 0, 0, 0, 0, 0, 0, 0.6, 0, 1.7}));
  EXPECT_EQ(read_discretisation_floor(file, tester::Fidelity::full).log_toughness_sd,
            DiscretisationFloor{}.log_toughness_sd);
  write_file_atomically(file, "[tiny]\nlog_toughness_sd = \"much\"\n");
  EXPECT_THROW(read_discretisation_floor(file, tester::Fidelity::tiny), InputError);
  write_file_atomically(file, "[tiny]\nlog_eta_sd = {w_vw = 0.6}\n");
  EXPECT_THROW(read_discretisation_floor(file, tester::Fidelity::tiny), InputError);
}

TEST(DiscretisationFloor, NoneIsZeroForEveryQuantity) {
  const DiscretisationFloor none = DiscretisationFloor::none();
  for (const double sd : {none.log_modulus_sd, none.log_toughness_sd, none.log_peak_sd, none.log_modulus_common_sd,
                          none.log_toughness_common_sd, none.log_peak_common_sd, none.log_modulus_trend_sd,
                          none.log_toughness_trend_sd, none.log_peak_trend_sd})
    EXPECT_EQ(sd, 0.0);
  EXPECT_EQ(none.log_eta_sd, material::ToughnessVector{});
}

/// One parameter acts (the failure energy of the interface), equally on all designs; the others do nothing.
struct OneSlope {
  FitData data;
  Point start = Point(kEtaCount, 0.5);
  FitTrial trial;
  Eigen::MatrixXd slopes;
  explicit OneSlope(int designs) {
    for (int i = 0; i < designs; ++i) {
      Replicates design;
      design.toughness_count = 1;
      design.toughness_pa = 2e5;
      data.measured.push_back(design);
      Prediction prediction;
      prediction.toughness_pa = 2e5;
      trial.predictions.push_back(prediction);
    }
    data.weights.assign(data.measured.size(), 1.0);
    trial.point = start;
    slopes = Eigen::MatrixXd::Zero(2 * designs, kEtaCount);
    slopes.col(kW0 + 2).head(designs).setConstant(3.0);
  }
};

TEST(FeaturePosterior, NarrowsAParameterAsTheRootOfTheDesigns) {
  const DiscretisationFloor floor{.log_toughness_sd = 0.2, .log_toughness_common_sd = 0.0};
  const auto deviation = [&](int designs) {
    OneSlope problem(designs);
    FeaturePosterior posterior(problem.data, problem.start, floor);
    posterior.set_base(problem.trial);
    const Eigen::MatrixXd covariance = posterior.posterior_covariance(problem.slopes);
    EXPECT_NEAR(covariance(kNu0, kNu0), 1.0 / 12.0, 1e-9);  // of the range alone
    return std::sqrt(covariance(kW0 + 2, kW0 + 2));
  };
  // Residuals of zero shrink the learnt variance by freedom / (freedom + designs) too.
  EXPECT_NEAR(deviation(40) / deviation(10), std::sqrt(10.0 / 40.0 * (6.0 + 10.0) / (6.0 + 40.0)), 0.02);
}

/// -log posterior of `problem` where log T of each design changes by changes[i], for sizes of the shared errors.
double cost_of(const OneSlope& problem, const DiscretisationFloor& floor, const std::vector<FeatureChange>& changes,
               const Eigen::VectorXd& shared, double deviation = 0.0) {
  FeaturePosterior posterior(problem.data, problem.start, floor);
  posterior.set_base(problem.trial);
  return posterior(problem.start, changes, deviation, shared);
}

TEST(FeaturePosterior, AnErrorCommonToAllDesignsIsNotAveragedAway) {
  const DiscretisationFloor floor{.log_toughness_sd = 0.2, .log_toughness_common_sd = 0.3};
  const OneSlope problem(400);
  const std::vector<FeatureChange> none(400), all(400, FeatureChange{0.6, 0.0});  // two standard deviations
  const Eigen::Vector3d error(2.0, 0.0, 0.0);
  EXPECT_NEAR(cost_of(problem, floor, all, error) - cost_of(problem, floor, none, Eigen::Vector3d::Zero()), 2.0, 1e-9);
  EXPECT_GT(cost_of(problem, floor, all, Eigen::Vector3d::Zero()), cost_of(problem, floor, all, error) + 100.0);
}

TEST(FeaturePosterior, WhatTheEmulatorMayBeWrongByIsNoEvidence) {
  const OneSlope problem(20);
  const std::vector<FeatureChange> none(20), all(20, FeatureChange{0.6, 0.0});
  const auto evidence = [&](double deviation) {
    const Eigen::VectorXd no_shared;
    return cost_of(problem, {}, all, no_shared, deviation) - cost_of(problem, {}, none, no_shared, deviation);
  };
  EXPECT_GT(evidence(0.0), 10.0);
  EXPECT_LT(evidence(1.0), 0.3 * evidence(0.0));
  // An uncertain emulator is no advantage either.
  EXPECT_GT(cost_of(problem, {}, none, Eigen::VectorXd(), 1.0), cost_of(problem, {}, none, Eigen::VectorXd(), 0.0));
}

TEST(FeaturePosterior, TenDesignsOfATenthOfTheWeightCountAsOne) {
  const DiscretisationFloor floor{.log_toughness_sd = 0.2, .log_toughness_common_sd = 0.0};
  struct DataWeight {
    double information, cost;  // on the parameter that acts; of a change of all toughnesses
  };
  const auto weight_of = [&](int designs, double evidence) {
    OneSlope problem(designs);
    for (measurement::Replicates& design : problem.data.measured) design.toughness_pa *= 1.5;
    problem.data.evidence.assign(problem.data.measured.size(), evidence);
    FeaturePosterior posterior(problem.data, problem.start, floor);
    posterior.set_base(problem.trial);
    const std::vector<FeatureChange> changes(problem.data.measured.size(), FeatureChange{0.1, 0.0});
    return DataWeight{1.0 / posterior.posterior_covariance(problem.slopes)(kW0 + 2, kW0 + 2),
                      posterior(problem.start, changes, 0.1, Eigen::VectorXd())};
  };
  const DataWeight whole = weight_of(4, 1.0), tenths = weight_of(40, 0.1);
  EXPECT_NEAR(tenths.information / whole.information, 1.0, 1e-9);
  EXPECT_NEAR(tenths.cost, whole.cost, 1e-9);
  EXPECT_GT(weight_of(40, 1.0).information / whole.information, 2.0);
}

TEST(FeaturePosterior, NorIsAnErrorThatGrowsWithTheRigidFraction) {
  const DiscretisationFloor floor{
      .log_toughness_sd = 0.2, .log_toughness_common_sd = 0.3, .log_toughness_trend_sd = 0.1};
  OneSlope problem(400);
  std::vector<FeatureChange> none(400), trend;
  for (std::size_t i = 0; i < 400; ++i) {
    const double fraction = i % 2 == 0 ? 0.6 : 0.8;
    problem.data.measured[i].design = pattern::Mixture{fraction};
    trend.push_back({0.15 * (fraction - 0.7) / 0.1, 0.0});
  }
  EXPECT_NEAR(cost_of(problem, floor, trend, Eigen::Vector3d(0.0, 1.5, 0.0)) -
                  cost_of(problem, floor, none, Eigen::Vector3d::Zero()),
              0.5 * 1.5 * 1.5, 1e-9);
}

TEST(FeaturePosterior, IsSmallestWhereTheResidualsVanish) {
  OneSlope problem(10);
  FeaturePosterior posterior(problem.data, problem.start, {});
  posterior.set_base(problem.trial);
  const auto cost = [&](double change) {
    const std::vector<FeatureChange> changes(10, FeatureChange{change, 0.0});
    return posterior(problem.start, changes);
  };
  EXPECT_LT(cost(0.0), cost(0.05));
  EXPECT_LT(cost(0.0), cost(-0.05));
  EXPECT_NEAR(cost(0.3), cost(-0.3), 1e-12);
}

}  // namespace
}  // namespace nacre::sysid
