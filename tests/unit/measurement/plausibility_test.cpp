#include "measurement/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nacre::measurement {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A steady rise to 40 MPa in 400 rows.
std::vector<double> rise() {
  std::vector<double> stress_pa;
  for (int i = 0; i < 400; ++i) stress_pa.push_back(1e5 * (i + 1));
  return stress_pa;
}

TEST(DoubtsOfCourse, AForceThatIsSetToZeroDuringThePullIsDoubted) {
  std::vector<double> stress_pa = rise();
  for (int i = 150; i < 400; ++i) stress_pa[i] -= 1.5e7;
  EXPECT_THAT(doubts_of_course(stress_pa), ElementsAre(HasSubstr("set to zero during the pull")));
}

// What breaks stays at zero; what cracks keeps a part of its force; what is unloaded loses it slowly.
TEST(DoubtsOfCourse, WhatBreaksCracksOrIsUnloadedIsNot) {
  std::vector<double> broken = rise();
  for (int i = 0; i < 50; ++i) broken.push_back(1e4);
  EXPECT_THAT(doubts_of_course(broken), IsEmpty());
  std::vector<double> cracked = rise();
  for (int i = 300; i < 400; ++i) cracked[i] *= 0.6;
  EXPECT_THAT(doubts_of_course(cracked), IsEmpty());
  std::vector<double> unloaded = rise();
  for (int i = 399; i > 0; i -= 5) unloaded.push_back(1e5 * i);
  for (int i = 0; i < 300; ++i) unloaded.push_back(1e5 * i);
  EXPECT_THAT(doubts_of_course(unloaded), IsEmpty());
}

TEST(DoubtsOfCourse, ALoadCellAtItsLimitIsDoubted) {
  std::vector<double> stress_pa = rise();
  for (double& value : stress_pa) value = std::min(value, 3e7);
  EXPECT_THAT(doubts_of_course(stress_pa), ElementsAre(HasSubstr("is the load cell at its limit?")));
}

}  // namespace
}  // namespace nacre::measurement
