#include "offline/diagnose.hpp"

#include <gtest/gtest.h>

#include "pattern/coupons.hpp"

namespace nacre::offline {
namespace {

TEST(DiagnoseSet, WithoutFracturesAllElseStays) {
  measurement::MeasurementSet set;
  using tester::TestKind;
  for (const TestKind test : {TestKind::modulus, TestKind::toughness, TestKind::tensile, TestKind::toughness}) {
    set.specimens.emplace_back();
    set.specimens.back().test = test;
  }
  const measurement::MeasurementSet left = without_fractures(set);
  ASSERT_EQ(left.specimens.size(), 2u);
  EXPECT_EQ(left.specimens[0].test, TestKind::modulus);
  EXPECT_EQ(left.specimens[1].test, TestKind::tensile);
}

TEST(DiagnoseSet, ANotchedSpecimenOfOneMaterialTakesPart) {
  measurement::MeasurementSet set;
  set.specimens.emplace_back();
  set.specimens.back().specimen = "rigid-1";
  set.specimens.back().design = pattern::Mixture{1.0};
  set.specimens.back().test = tester::TestKind::toughness;
  set.specimens.back().toughness_pa = 1e5;
  diagnosis::DiagnosisSettings settings;
  settings.fidelity = tester::Fidelity::tiny;
  const DiagnosedSet diagnosed = diagnose_set(set, settings);
  EXPECT_EQ(diagnosed.diagnosis.verdict, diagnosis::Verdict::insufficient);
  EXPECT_EQ(diagnosed.diagnosis.residuals.size(), 1u) << "its toughness; it has no curve";
}

}  // namespace
}  // namespace nacre::offline
