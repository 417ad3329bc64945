#include "diagnosis/fracture_discretisation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "diagnosis/observations.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::diagnosis {
namespace {

constexpr const char* kShipped = NACRE_SOURCE_DIR "/data/discretisation_floor.toml";

std::filesystem::path file_with(const std::string& shared) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "numerics_test.toml";
  const std::string unit = "[[1.0, 0.0], [0.0, 1.0]]\n";
  write_file_atomically(path, "[tiny.curve]\nfeatures = [\"log_toughness\", \"log_peak\"]\ncovariance_shared = " +
                                  shared + "\ncovariance_rigid = " + unit + "covariance_layout = " + unit);
  return path;
}

/// Fracture tests of many layouts whose replicates scatter as little as a testing machine allows.
Observations tidy_laboratory(const FractureDiscretisation& discretisation) {
  Observations observations;
  RandomStream random(3, "numerics test");
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(24, random)) {
    for (const Feature feature : discretisation.features)
      observations.rows.push_back(
          {static_cast<int>(observations.groups.size()), feature, RowKind::mean, tester::TestKind::toughness, 0.25});
    observations.groups.emplace_back();
    observations.groups.back().design = pattern;
    observations.groups.back().test = tester::TestKind::toughness;
  }
  for (ReplicateScatter& scatter : observations.scatter)
    scatter.covariance = 4e-8 * Eigen::MatrixXd::Identity(kFeatureCount, kFeatureCount);
  observations.fracture_discretisation = discretisation;
  return observations;
}

// The matrices are sums over five parameter sets, so that half of their eigenvalues are zero but for the digits that
// are printed. Below zero, and shared by all layouts, they can outweigh the scatter.
TEST(FractureDiscretisation, TheShippedMatricesLeaveTheDataAPositiveCovariance) {
  const FractureDiscretisation discretisation = read_fracture_discretisation(kShipped, tester::Fidelity::tiny);
  ASSERT_FALSE(discretisation.features.empty());
  EXPECT_NO_THROW(Whitener(tidy_laboratory(discretisation).covariance()));
}

TEST(FractureDiscretisation, RoundingBelowZeroIsTakenForZero) {
  const FractureDiscretisation discretisation =
      read_fracture_discretisation(file_with("[[1.0, 1.0001], [1.0001, 1.0]]"), tester::Fidelity::tiny);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(discretisation.shared);
  EXPECT_GE(parts.eigenvalues().minCoeff(), -1e-12);
  EXPECT_NEAR(discretisation.shared(0, 1), 1.0, 1e-3);
}

TEST(FractureDiscretisation, WhatIsNoCovarianceIsAnErrorThatNamesTheKey) {
  for (const char* matrix : {"[[1.0, 2.0], [2.0, 1.0]]", "[[1.0, 0.5], [0.2, 1.0]]", "[[0.0, 0.0], [0.0, 1.0]]"}) {
    try {
      read_fracture_discretisation(file_with(matrix), tester::Fidelity::tiny);
      FAIL() << matrix << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("covariance_shared"), std::string::npos) << error.what();
    }
  }
}

TEST(Whitener, RefusesWhatIsNotFinite) {
  EXPECT_THROW(Whitener(Eigen::Matrix2d::Constant(std::nan(""))), std::runtime_error);
}

TEST(Whitener, RefusesWhatIsNotPositiveDefinite) {
  EXPECT_THROW(Whitener((Eigen::Matrix2d() << 1.0, 2.0, 2.0, 1.0).finished()), std::runtime_error);
}

/// Layouts whose toughness changes by this much from one to the next beside a common change, and a tough one's more;
/// specimens scatter, on either mesh by themselves.
std::vector<RefinedLayout> refined_layouts(int count, double change_sd, double scatter) {
  RandomStream random(11, "refined layouts");
  std::vector<RefinedLayout> layouts;
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(count, random)) {
    RefinedLayout layout{.design = pattern, .coarse = {}, .fine = {}};
    const double change = 0.1 + 0.05 * rigid_position(layout.design) + change_sd * random.normal();
    for (int k = 0; k < 4; ++k) {
      FeatureValues coarse, fine;
      value_of(coarse, Feature::log_toughness) = 12.0 + scatter * random.normal();
      value_of(fine, Feature::log_toughness) = 12.0 + change + scatter * random.normal();
      layout.coarse.push_back(coarse), layout.fine.push_back(fine);
    }
    layouts.push_back(std::move(layout));
  }
  return layouts;
}

double sd_of_toughness(const FractureDiscretisation& discretisation) {
  return std::sqrt(discretisation.covariance(Feature::log_toughness, Feature::log_toughness, 0.0, 0.0, true) -
                   discretisation.covariance(Feature::log_toughness, Feature::log_toughness, 0.0, 0.0, false));
}

TEST(FractureDiscretisation, AtOwnConstantsIsWhatTheLayoutsShow) {
  const FractureDiscretisation table = read_fracture_discretisation(kShipped, tester::Fidelity::tiny);
  double sum = 0.0;
  for (const double sd : {0.03, 0.06, 0.12}) {
    const double found = sd_of_toughness(at_own_constants(table, refined_layouts(40, sd, 0.05), {}));
    EXPECT_NEAR(found, sd, 0.35 * sd);
    EXPECT_GT(found, sum) << "more, where layouts differ more";
    sum = found;
  }
}

TEST(FractureDiscretisation, AtOwnConstantsKeepsTheTableWhereLittleIsShown) {
  const FractureDiscretisation table = read_fracture_discretisation(kShipped, tester::Fidelity::tiny);
  EXPECT_EQ(sd_of_toughness(at_own_constants(table, refined_layouts(2, 0.03, 0.05), {})), sd_of_toughness(table));
  const FractureDiscretisation own = at_own_constants(table, refined_layouts(40, 0.03, 0.05), {});
  EXPECT_EQ(own.layout(6, 6), table.layout(6, 6)) << "the peak, which these layouts do not show";
  EXPECT_EQ(own.shared, table.shared);
  EXPECT_NO_THROW(Whitener(tidy_laboratory(own).covariance()));
}

TEST(FractureDiscretisation, WithoutATableItIsTheLayoutsOwn) {
  const FractureDiscretisation own = at_own_constants({}, refined_layouts(40, 0.06, 0.05), {});
  EXPECT_NEAR(sd_of_toughness(own), 0.06, 0.02);
  EXPECT_NEAR(std::sqrt(own.shared(0, 0)), 0.1, 0.03) << "the common change";
}

}  // namespace
}  // namespace nacre::diagnosis
