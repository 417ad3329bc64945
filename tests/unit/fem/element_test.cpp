#include "fem/element.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace nacre::fem {
namespace {

constexpr material::Lame kLame{.mu_pa = 3.0e8, .lambda_pa = 7.0e8};

/// Displacements of the four nodes under x -> x + H x.
ElementVector linear_field(const Eigen::Matrix2d& h) {
  ElementVector displacement;
  for (int node = 0; node < kElementNodes; ++node)
    displacement.segment<2>(2 * node) = h * Eigen::Vector2d(node % 2, node / 2);
  return displacement;
}

ElementVector some_displacement(double size) {
  RandomStream random(1, "element_test");
  ElementVector displacement;
  for (int i = 0; i < 8; ++i) displacement[i] = random.uniform(-size, size);
  return displacement;
}

TEST(Element, LinearFieldHasItsGradientAtEveryPoint) {
  Eigen::Matrix2d h;
  h << 0.1, -0.2, 0.05, 0.3;
  for (const ShapeGradients& gradients : shape_gradients())
    EXPECT_LT((displacement_gradient(linear_field(h), gradients) - h).norm(), 1e-15);
}

TEST(Element, ForceIsTheDerivativeOfTheEnergy) {
  const ElementVector displacement = some_displacement(0.15);
  ElementVector force;
  ASSERT_TRUE(internal_force(displacement, kLame, force));
  for (int i = 0; i < 8; ++i) {
    ElementVector step = ElementVector::Zero();
    step[i] = 1e-6;
    const double difference =
        (strain_energy(displacement + step, kLame) - strain_energy(displacement - step, kLame)) / 2e-6;
    EXPECT_NEAR(force[i], difference, 1e-7 * kLame.lambda_pa);
  }
}

TEST(Element, ForceIsTheStressOfTheLawSummedOverThePoints) {
  const ElementVector displacement = some_displacement(0.15);
  ElementVector force, expected = ElementVector::Zero();
  ASSERT_TRUE(internal_force(displacement, kLame, force));
  for (const ShapeGradients& gradients : shape_gradients()) {
    const Eigen::Matrix2d stress = material::first_piola(displacement_gradient(displacement, gradients), kLame);
    for (int node = 0; node < kElementNodes; ++node)
      expected.segment<2>(2 * node) += kGaussWeight * stress * gradients.col(node);
  }
  EXPECT_LT((force - expected).norm(), 1e-14 * kLame.lambda_pa);
}

TEST(Element, StiffnessIsTheDerivativeOfTheForceAtRest) {
  const ElementMatrix stiffness = kLame.mu_pa * unit_stiffness().shear + kLame.lambda_pa * unit_stiffness().bulk;
  for (int i = 0; i < 8; ++i) {
    ElementVector step = ElementVector::Zero(), up, down;
    step[i] = 1e-6;
    ASSERT_TRUE(internal_force(step, kLame, up) && internal_force(-step, kLame, down));
    EXPECT_LT((stiffness.col(i) - (up - down) / 2e-6).norm(), 1e-8 * stiffness.norm());
  }
}

// Two translations and one rotation; reduced integration would show two hourglass modes more.
TEST(Element, StiffnessLeavesOnlyRigidMotionsFree) {
  const ElementMatrix stiffness = kLame.mu_pa * unit_stiffness().shear + kLame.lambda_pa * unit_stiffness().bulk;
  const Eigen::SelfAdjointEigenSolver<ElementMatrix> modes(stiffness);
  for (int i = 0; i < 8; ++i) {
    if (i < 3)
      EXPECT_NEAR(modes.eigenvalues()[i], 0.0, 1e-14 * modes.eigenvalues()[7]);
    else
      EXPECT_GT(modes.eigenvalues()[i], 0.05 * modes.eigenvalues()[7]);
  }
}

TEST(Element, RigidRotationCausesNoForce) {
  ElementVector force;
  for (const double angle : {1e-5, 0.3, 2.0}) {
    Eigen::Matrix2d h = Eigen::Rotation2Dd(angle).toRotationMatrix() - Eigen::Matrix2d::Identity();
    ASSERT_TRUE(internal_force(linear_field(h), kLame, force));
    EXPECT_LT(force.norm(), 1e-14 * kLame.lambda_pa);
  }
}

TEST(Element, ForcesAndMomentsBalance) {
  const ElementVector displacement = some_displacement(0.15);
  ElementVector force;
  ASSERT_TRUE(internal_force(displacement, kLame, force));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double moment = 0.0;
  for (int node = 0; node < kElementNodes; ++node) {
    const Eigen::Vector2d f = force.segment<2>(2 * node);
    const Eigen::Vector2d x = Eigen::Vector2d(node % 2, node / 2) + displacement.segment<2>(2 * node);
    sum += f;
    moment += x[0] * f[1] - x[1] * f[0];
  }
  EXPECT_LT(sum.norm(), 1e-14 * kLame.lambda_pa);
  EXPECT_NEAR(moment, 0.0, 1e-14 * kLame.lambda_pa);
}

TEST(Element, TurnedInsideOutIsReported) {
  Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
  h(0, 0) = -1.5;
  ElementVector force;
  EXPECT_FALSE(internal_force(linear_field(h), kLame, force));
}

}  // namespace
}  // namespace nacre::fem
