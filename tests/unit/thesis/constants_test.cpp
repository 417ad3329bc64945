#include "thesis/constants.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nacre::thesis {
namespace {

// What the thesis states twice must agree, and what is called inferred must follow.

TEST(Constants, TheGridOfTheToughnessTesterIsAsWideAsTheSpecimen) {
  const int elements = kToughnessUnitsX * kPixelsPerSide * kElementsPerPixel;
  EXPECT_EQ(elements, 200);
  EXPECT_NEAR(elements * kElementSize, kSpecimenWidth, 1e-12);
  EXPECT_EQ(kToughnessUnitsY * kPixelsPerSide * kElementsPerPixel, 160);
  EXPECT_EQ(kModulusUnitsX * kPixelsPerSide * kElementsPerPixel, 80);
  EXPECT_EQ(kModulusUnitsY * kPixelsPerSide * kElementsPerPixel, 40);
}

TEST(Constants, NotchAndCutAreTheSharesOfTheWidthThatTheyAreSaidToBe) {
  EXPECT_NEAR(kNotchLength / kSpecimenWidth, 0.20, 1e-12);
  EXPECT_NEAR(kCutDepth / kSpecimenWidth, 0.15, 1e-12);
  EXPECT_EQ(kNotchElements, std::lround(0.20 * 200));
  EXPECT_EQ(kCutElements, std::lround(0.15 * 200));
}

TEST(Constants, TheTimeStepIsTheOneThatNeeds162MillionSteps) {
  const double duration_s = 0.02 * kGaugeLength / kGripSpeed;
  EXPECT_NEAR(duration_s, 32.4, 1e-9);
  EXPECT_NEAR(duration_s / 1.62e8, kTimeStep, 1e-9 * kTimeStep);
  EXPECT_NEAR(kTestStrainRate, 6.17e-4, 0.01e-4);
}

TEST(Constants, TheGaugeIsTheSpecimenWithoutItsGrips) { EXPECT_NEAR(kSpecimenLength - 2 * 25e-3, kGaugeLength, 1e-12); }

TEST(Constants, MutationProbabilitiesAddUp) {
  EXPECT_NEAR(kPixelMutation + kLineMutation + kSquareMutation, 1.0, 1e-15);
}

TEST(Constants, TheWeightOfEquation29IsContinuous) {
  EXPECT_NEAR(1.4 - 2.0 * kNearFront, 1.0, 1e-15);
  EXPECT_NEAR(1.4 - 2.0 * kFarFromFront, kFarWeight, 1e-15);
}

TEST(Constants, TheSearchBudgetIsItsIterationsTimesTheirBatch) {
  EXPECT_EQ(kSearchIterations * kSearchBatch, kSearchBudget);
}

}  // namespace
}  // namespace nacre::thesis
