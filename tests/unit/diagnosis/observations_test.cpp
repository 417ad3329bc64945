#include <cmath>

#include <gtest/gtest.h>

#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {
namespace {

measurement::SpecimenRecord pulled(const std::string& specimen, double orientation_deg, double modulus_pa) {
  measurement::SpecimenRecord record;
  record.specimen = specimen;
  record.design = *pattern::design_from_name("577fffe9fffdef");
  record.conditions.orientation_deg = orientation_deg;
  record.modulus_pa = modulus_pa;
  return record;
}

TEST(Observations, ReplicatesThatAgreeExactlyLeaveAFiniteWeight) {
  // Rotated twins share what the numerics leave: nothing but scatter keeps their covariance from being singular.
  const Observations observations =
      observe_moduli({pulled("a/1", 0, 2e8), pulled("a/2", 0, 2e8), pulled("b/1", 90, 2.2e8), pulled("b/2", 90, 2.2e8)}, 0.02);
  ASSERT_EQ(observations.replicate_dof, 2);
  const Whitener whitener(observations.covariance());
  const double chi2 = whitener.chi2(Eigen::Vector2d(0.0, 0.01));
  EXPECT_TRUE(std::isfinite(chi2));
  EXPECT_GT(chi2, 1.0) << "a percent is still far more than they scatter";
}

TEST(Observations, ScatterIsThatOfTheReplicates) {
  const Observations observations = observe_moduli({pulled("a/1", 0, 2e8), pulled("a/2", 0, 2.1e8)}, 0.0);
  EXPECT_NEAR(observations.replicate_sd, std::log(2.1 / 2.0) / std::sqrt(2.0), 1e-12);
}

Observations three_groups() {
  Observations observations;
  for (const char* key : {"577fffe9fffdef", "3ffc9b4ad4d2d9", "7fffffffffffff"}) {
    observations.groups.emplace_back();
    observations.groups.back().design = *pattern::design_from_name(key);
    observations.groups.back().replicates = 4;
  }
  observations.replicate_sd = 0.01;
  observations.numerics_sd = 0.002;
  observations.numerics_shared = Eigen::Vector3d(0.05, 0.1, -0.02);
  return observations;
}

TEST(Observations, LayoutsGoTogetherAlongTheSharedDirectionOfTheNumerics) {
  const Eigen::MatrixXd covariance = three_groups().covariance();
  EXPECT_NEAR(covariance(0, 1), 0.05 * 0.1, 1e-12);
  EXPECT_NEAR(covariance(1, 2), -0.1 * 0.02, 1e-12);
  EXPECT_NEAR(covariance(0, 0), 0.01 * 0.01 / 4 + 0.002 * 0.002 + 0.05 * 0.05, 1e-12);
}

// What lies along the direction is expected to be numerics, also where nothing was measured; what lies across it is not.
TEST(Observations, ResidualsAlongTheSharedDirectionAreTakenForNumerics) {
  const Observations observations = three_groups();
  const Eigen::VectorXd expected = observations.shared_numerics(Eigen::Vector2d(0.05, 0.1), {0, 1});
  EXPECT_NEAR(expected[0], 0.05, 0.001);
  EXPECT_NEAR(expected[2], -0.02, 0.001);
  const Eigen::VectorXd across = observations.shared_numerics(Eigen::Vector2d(0.1, -0.05), {0, 1});
  EXPECT_LT(across.norm(), 1e-3);
}

}  // namespace
}  // namespace nacre::diagnosis
