#include "material/neo_hookean.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace nacre::material {
namespace {

constexpr Lame kSoft{.mu_pa = 3.0e8, .lambda_pa = 7.0e8};

/// Displacement gradients of up to 30 %, J > 0.
std::vector<Eigen::Matrix2d> some_gradients() {
  RandomStream random(1, "neo_hookean_test");
  std::vector<Eigen::Matrix2d> gradients;
  for (int i = 0; i < 20; ++i) {
    Eigen::Matrix2d h;
    for (int k = 0; k < 4; ++k) h(k / 2, k % 2) = random.uniform(-0.3, 0.3);
    gradients.push_back(h);
  }
  return gradients;
}

TEST(NeoHookean, StressIsTheDerivativeOfTheEnergy) {
  for (const Eigen::Matrix2d& h : some_gradients()) {
    const Eigen::Matrix2d stress = first_piola(h, kSoft);
    for (int k = 0; k < 4; ++k) {
      Eigen::Matrix2d step = Eigen::Matrix2d::Zero();
      step(k / 2, k % 2) = 1e-6;
      const double difference = (energy_density(h + step, kSoft) - energy_density(h - step, kSoft)) / 2e-6;
      EXPECT_NEAR(stress(k / 2, k % 2), difference, 1e-7 * kSoft.lambda_pa);
    }
  }
}

TEST(NeoHookean, TangentIsTheDerivativeOfTheStressAndSymmetric) {
  for (const Eigen::Matrix2d& h : some_gradients()) {
    const Eigen::Matrix4d moduli = tangent(h, kSoft);
    EXPECT_LT((moduli - moduli.transpose()).norm(), 1e-14 * moduli.norm());
    for (int k = 0; k < 4; ++k) {
      Eigen::Matrix2d step = Eigen::Matrix2d::Zero();
      step(k / 2, k % 2) = 1e-6;
      const Eigen::Matrix2d difference = (first_piola(h + step, kSoft) - first_piola(h - step, kSoft)) / 2e-6;
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(moduli(i, k), difference(i / 2, i % 2), 1e-7 * kSoft.lambda_pa);
    }
  }
}

// Eq. 2.1 as printed, with ln J in place of 2 ln J, would leave a stress of mu/2 at rest.
TEST(NeoHookean, NothingIsStressedAtRest) {
  EXPECT_EQ(first_piola(Eigen::Matrix2d::Zero(), kSoft).norm(), 0.0);
  EXPECT_EQ(energy_density(Eigen::Matrix2d::Zero(), kSoft), 0.0);
}

TEST(NeoHookean, RotationCostsNoEnergyAndNoStress) {
  for (const double angle : {1e-6, 0.1, 1.0, 3.0}) {
    Eigen::Matrix2d h;
    h << std::cos(angle) - 1.0, -std::sin(angle), std::sin(angle), std::cos(angle) - 1.0;
    EXPECT_LT(first_piola(h, kSoft).norm(), 1e-15 * 10 * kSoft.lambda_pa);
    EXPECT_NEAR(energy_density(h, kSoft), 0.0, 1e-15 * 10 * kSoft.lambda_pa);
  }
}

TEST(NeoHookean, StressTurnsWithTheMaterial) {
  const Eigen::Rotation2Dd rotation(0.7);
  for (const Eigen::Matrix2d& h : some_gradients()) {
    const Eigen::Matrix2d turned = rotation * (Eigen::Matrix2d::Identity() + h) - Eigen::Matrix2d::Identity();
    EXPECT_LT((first_piola(turned, kSoft) - rotation * first_piola(h, kSoft)).norm(), 1e-13 * kSoft.lambda_pa);
  }
}

TEST(NeoHookean, SimpleShearIsLinear) {
  for (const double shear : {1e-6, 0.1, 0.5, 2.0}) {
    Eigen::Matrix2d h, expected;
    h << 0.0, shear, 0.0, 0.0;
    expected << 0.0, kSoft.mu_pa * shear, kSoft.mu_pa * shear, 0.0;
    EXPECT_LT((first_piola(h, kSoft) - expected).norm(), 1e-14 * kSoft.mu_pa * shear);
    EXPECT_NEAR(energy_density(h, kSoft), 0.5 * kSoft.mu_pa * shear * shear, 1e-9 * kSoft.mu_pa * shear * shear);
  }
}

// F - F^-T computed directly would keep no more than 8 of 16 digits here.
TEST(NeoHookean, TinyStrainsKeepTheirDigits) {
  Eigen::Matrix2d h;
  h << 1e-9, 2e-9, -3e-9, 4e-9;
  const double trace = h.trace();
  const Eigen::Matrix2d linear =
      kSoft.mu_pa * (h + h.transpose()) + kSoft.lambda_pa * trace * Eigen::Matrix2d::Identity();
  EXPECT_LT((first_piola(h, kSoft) - linear).norm(), 1e-8 * linear.norm());
  EXPECT_NEAR(energy_density(h, kSoft) / (0.5 * (linear.cwiseProduct(h)).sum()), 1.0, 1e-6);
}

TEST(Engineering, SmallUniaxialStressGivesYoungAndPoissonBack) {
  for (const double poisson : {0.0, 0.2, 0.35, 0.49, 0.5}) {
    const Lame lame = lame_from_engineering(2.5e9, poisson);
    const UniaxialState state = uniaxial_stress(1e-8, lame);
    EXPECT_NEAR(state.nominal_stress_pa / 1e-8, 2.5e9, 2.5e9 * 1e-7);
    EXPECT_NEAR((1.0 - state.lateral_stretch) / 1e-8, poisson, 1e-7);
  }
}

TEST(Engineering, LameParametersAreThoseOfPlaneStress) {
  for (const double poisson : {0.1, 0.3, 0.45, 0.5}) {
    const Lame lame = lame_from_engineering(1.0, poisson);
    EXPECT_NEAR(lame.mu_pa, 0.5 / (1.0 + poisson), 1e-15);
    EXPECT_NEAR(lame.lambda_pa, poisson / (1.0 - poisson * poisson), 1e-15);
  }
}

TEST(Uniaxial, LateralStressVanishesAndTheStressIsTheLaws) {
  for (const double strain : {-0.5, -0.01, 1e-4, 0.1, 1.0, 3.0}) {
    const UniaxialState state = uniaxial_stress(strain, kSoft);
    const Eigen::Matrix2d h = Eigen::Vector2d(state.lateral_stretch - 1.0, strain).asDiagonal();
    const Eigen::Matrix2d stress = first_piola(h, kSoft);
    EXPECT_NEAR(stress(0, 0), 0.0, 1e-14 * kSoft.lambda_pa);
    EXPECT_NEAR(state.nominal_stress_pa, stress(1, 1), 1e-14 * kSoft.lambda_pa);
  }
}

TEST(Uniaxial, WithoutLateralCouplingTheStressIsClosed) {
  const Lame lame = lame_from_engineering(2.0, 0.0);  // lambda = 0, mu = 1: P = F - 1/F
  for (const double strain : {-0.3, 0.2, 1.0}) {
    const double stretch = 1.0 + strain;
    EXPECT_NEAR(uniaxial_stress(strain, lame).nominal_stress_pa, stretch - 1.0 / stretch, 1e-14);
    EXPECT_NEAR(uniaxial_stress(strain, lame).lateral_stretch, 1.0, 1e-15);
  }
}

// For lambda -> infinity the area is kept: F11 = 1/F22, P22 = mu (F22 - F22^-3).
TEST(Uniaxial, StiffInVolumeKeepsTheArea) {
  const Lame lame{.mu_pa = 1.0, .lambda_pa = 1e9};
  const double stretch = 1.5;
  EXPECT_NEAR(uniaxial_stress(0.5, lame).lateral_stretch, 1.0 / stretch, 1e-8);
  EXPECT_NEAR(uniaxial_stress(0.5, lame).nominal_stress_pa, stretch - std::pow(stretch, -3), 1e-8);
}

}  // namespace
}  // namespace nacre::material
