#include "diagnosis/included_specimens.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

SpecimenRecord specimen(const pattern::Design& design, TestKind test, bool valid = true) {
  SpecimenRecord record;
  record.design = design;
  record.test = test;
  record.valid = valid;
  return record;
}

class IncludedSpecimensTest : public testing::Test {
 protected:
  pattern::Design layout_ = *pattern::design_from_name("577fffe9fffdef"), bulk_ = pattern::Mixture{1.0};
  std::vector<SpecimenRecord> fractures_ = {specimen(layout_, TestKind::toughness),
                                            specimen(layout_, TestKind::toughness)};
  std::vector<SpecimenRecord> fractures_and(const SpecimenRecord& other) const {
    std::vector<SpecimenRecord> specimens = fractures_;
    specimens.push_back(other);
    return specimens;
  }
  static bool breaks_any(const IncludedSpecimens& part) {
    return std::ranges::count(part.specimens, TestKind::toughness, &SpecimenRecord::test) > 0;
  }
};

TEST_F(IncludedSpecimensTest, FracturesAreLeftOutBesideModuli) {
  const auto specimens = fractures_and(specimen(layout_, TestKind::modulus));
  const IncludedSpecimens part = included_specimens(specimens, false);
  EXPECT_FALSE(breaks_any(part));
  EXPECT_EQ(part.fractures_left_out, 2);
  EXPECT_TRUE(breaks_any(included_specimens(specimens, true)));
}

// An unusable modulus, or one of a homogeneous specimen, is no reason to leave fractures out.
TEST_F(IncludedSpecimensTest, FracturesAreIncludedWhereNothingElseWouldBe) {
  EXPECT_TRUE(breaks_any(included_specimens(fractures_, false)));
  EXPECT_TRUE(breaks_any(included_specimens(fractures_and(specimen(layout_, TestKind::modulus, false)), false)));
  EXPECT_TRUE(breaks_any(included_specimens(fractures_and(specimen(bulk_, TestKind::modulus)), false)));
  EXPECT_FALSE(breaks_any(included_specimens(fractures_and(specimen(bulk_, TestKind::tensile)), false)));
}

TEST_F(IncludedSpecimensTest, OnlyUsableFracturesAreCountedAsLeftOut) {
  fractures_.front().valid = false;
  const IncludedSpecimens part = included_specimens(fractures_and(specimen(layout_, TestKind::modulus)), false);
  EXPECT_EQ(part.fractures_left_out, 1);
}

}  // namespace
}  // namespace nacre::diagnosis
