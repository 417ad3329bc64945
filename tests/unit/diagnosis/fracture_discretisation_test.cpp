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

}  // namespace
}  // namespace nacre::diagnosis
