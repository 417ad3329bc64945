#include "measurement/typed_specimen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace nacre::measurement {
namespace {

SpecimenRecord notched() {
  SpecimenRecord record;
  record.specimen = "a";
  record.design = *pattern::design_from_name("577fffe9fffdef");
  record.test = tester::TestKind::toughness;
  record.conditions.thickness_mm = 3.17;
  record.batch = "round-1, second tray";
  record.print_order = 7;
  record.note = "a \"quoted\" note";
  for (int i = 0; i < 7; ++i) {
    record.curve.strain.push_back(0.01 * i / 3.0);
    record.curve.stress_pa.push_back(1e6 * (3 - std::abs(3 - i)) / 7.0);
  }
  return record;
}

TEST(AmendedSpecimen, KeepsToTheBitWhatDoesNotChange) {
  const SpecimenRecord record = notched();
  const auto same = with_changes(record, {});
  ASSERT_TRUE(same) << same.error().reason;
  EXPECT_EQ(*same, record);
  SpecimenRecord expected = record;
  expected.toughness_pa = 1.5e5;
  expected.conditions.thickness_mm = 3.2;
  const auto changed = with_changes(record, {{"toughness_pa", "150000"}, {"thickness_mm", "3.2"}});
  ASSERT_TRUE(changed) << changed.error().reason;
  EXPECT_EQ(*changed, expected);
}

TEST(AmendedSpecimen, IsCheckedAsAnyOther) {
  const auto refused = [](const std::string& column, const std::string& cell) {
    const auto changed = with_changes(notched(), {{column, cell}});
    return changed ? "" : changed.error().column;
  };
  EXPECT_EQ(refused("thickness_mm", "-1"), "thickness_mm");
  EXPECT_EQ(refused("pattern", "no-design"), "pattern");
  EXPECT_EQ(refused("toughness_pa", "1e15"), "toughness_pa");
  EXPECT_EQ(refused("specimen", "b"), "specimen") << "another name is another specimen";
  EXPECT_EQ(refused("curve", "x.csv"), "curve");
  EXPECT_EQ(refused("colour", "red"), "colour");
}

}  // namespace
}  // namespace nacre::measurement
