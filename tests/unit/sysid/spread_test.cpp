#include "sysid/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "sysid/emulator.hpp"
#include "sysid/least_squares_fit.hpp"

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

TEST(ParameterDeviations, RowsWithoutWeightCountNowhere) {
  Eigen::VectorXd residuals = Eigen::VectorXd::Zero(16), weights = residuals;
  for (int i = 0; i < 8; ++i) residuals[i] = i % 2 == 0 ? 0.1 : -0.1;
  weights.head(8).setOnes();
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Ones(16, 1);
  const double expected = parameter_deviations(jacobian.topRows(8), residuals.head(8), weights.head(8), 0.01).front();
  EXPECT_DOUBLE_EQ(parameter_deviations(jacobian, residuals, weights, 0.01).front(), expected);
  EXPECT_EQ(parameter_deviations(jacobian, residuals, Eigen::VectorXd::Zero(16), 0.01).front(), kUnknownDeviation);
}

TEST(FreedomTaken, IsTheNumberOfParametersThatTheDataTell) {
  const Eigen::MatrixXd jacobian = (Eigen::MatrixXd(4, 3) << 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0).finished();
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(4);
  EXPECT_NEAR(freedom_taken(jacobian, weights, 1e-9, 4), 2.0, 1e-6) << "the third does nothing";
  EXPECT_NEAR(freedom_taken(jacobian, weights, 1e-9, 2), 1.0, 1e-6) << "from the first two residuals";
  EXPECT_NEAR(freedom_taken(jacobian, Eigen::Vector4d(1, 0, 1, 0), 1e-9, 4), 2.0, 1e-6) << "rows without weight";
}

TEST(FreedomTaken, OfParametersThatActAlikeIsOne) {
  EXPECT_NEAR(freedom_taken(Eigen::MatrixXd::Ones(5, 3), Eigen::VectorXd::Ones(5), 1e-9, 5), 1.0, 1e-6);
}

TEST(FreedomTaken, IsLessWherePriorAndDataShare) {
  // Information 4 from the data, 12 from the prior.
  EXPECT_NEAR(freedom_taken(Eigen::MatrixXd::Ones(4, 1), Eigen::VectorXd::Ones(4), 12.0, 4), 4.0 / 16.0, 1e-12);
}

// Log E of each design is linear in all six coordinates, and off by a twentieth that none of them explains.
std::vector<Prediction> linear_moduli(const Point& point, int designs, int failing) {
  std::vector<Prediction> predictions(designs + failing);
  for (int i = 0; i < designs; ++i) {
    RandomStream random(static_cast<std::uint64_t>(i), "design");
    double log_modulus = 0.05 * random.normal();
    for (const double x : point) log_modulus += random.normal() * (x - 0.5);
    predictions[i].modulus_pa = 1e9 * std::exp(log_modulus);
  }
  return predictions;
}

std::unique_ptr<ParameterFit> fitted_moduli(int designs, int failing) {
  measurement::Replicates design;
  design.modulus_count = 1;
  design.modulus_pa = 1e9;
  const std::size_t count = static_cast<std::size_t>(designs + failing);
  auto fit = make_modulus_fit({.measured = std::vector(count, design), .weights = std::vector(count, 1.0)},
                              {.start = Point(6, 0.5), .budget = 60, .floor = DiscretisationFloor::none()});
  for (std::vector<Point> points = fit->ask(); !points.empty(); points = fit->ask()) {
    std::vector<std::vector<Prediction>> told;
    for (const Point& point : points) told.push_back(linear_moduli(point, designs, failing));
    fit->tell(std::move(told));
  }
  return fit;
}

std::vector<CoordinateInterval> modulus_intervals(int designs, int failing) {
  return fitted_moduli(designs, failing)->intervals();
}

TEST(LeastSquaresFit, TakesADegreeOfFreedomForEachParameterThatTheDataTell) {
  EXPECT_NEAR(fitted_moduli(12, 0)->freedom_taken(), 6.0, 0.05);
  EXPECT_NEAR(fitted_moduli(12, 20)->freedom_taken(), 6.0, 0.05) << "a design that fails carries no information";
  EXPECT_NEAR(fitted_moduli(4, 0)->freedom_taken(), 4.0, 0.05);
}

TEST(LeastSquaresFit, DesignsWhoseSimulationFailsNarrowNoInterval) {
  const auto alone = modulus_intervals(12, 0), with_failures = modulus_intervals(12, 20);
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_LT(alone[j].deviation, 0.5 * kUnknownDeviation) << j;
    EXPECT_NEAR(with_failures[j].deviation, alone[j].deviation, 0.05 * alone[j].deviation) << j;
  }
}

TEST(ToughnessDeviations, ASetWithoutCurvesHasARowForEachDesign) {
  constexpr int kDesigns = 12;
  FitData data{.measured = {}, .weights = std::vector<double>(kDesigns, 1.0)};
  FitTrial trial{.point = Point(kEtaCount, 0.5), .predictions = {}};
  Eigen::VectorXd residuals(kDesigns);
  for (int i = 0; i < kDesigns; ++i) {
    measurement::Replicates design;
    design.toughness_count = 1;
    design.toughness_pa = 2e5;
    residuals[i] = i % 2 == 0 ? 0.2 : -0.2;
    data.measured.push_back(design);
    trial.predictions.push_back({.modulus_pa = {}, .toughness_pa = 2e5 * std::exp(residuals[i]), .curve = {}});
  }
  std::vector<FitTrial> trials = {trial, trial};
  trials[1].point[kW0] = 0.6;
  const std::vector<double> spans(kEtaCount, 2.0);
  FeatureEmulator emulator(spans, kDesigns);
  emulator.learn(trials, 0);
  const Eigen::MatrixXd slopes = feature_slopes(emulator, trial.point, kDesigns, /*poisson_searched=*/false);
  // Seven coordinates are searched, Poisson's ratios are not.
  const double deviation = 0.2 * std::sqrt(kDesigns / (kDesigns - 7.0));
  Eigen::MatrixXd information = slopes.topRows(kDesigns).transpose() * slopes.topRows(kDesigns) / deviation / deviation;
  information.diagonal().array() += 12.0;
  const Eigen::MatrixXd covariance = information.inverse();
  const auto deviations = toughness_deviations(data, trials, 0, spans, false, DiscretisationFloor::none());
  for (int j = 0; j < kEtaCount; ++j) EXPECT_NEAR(deviations[j], std::sqrt(covariance(j, j)), 1e-9) << j;
}

}  // namespace
}  // namespace nacre::sysid
