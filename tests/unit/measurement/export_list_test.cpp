#include "measurement/export_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "base/files.hpp"

namespace nacre::measurement {
namespace {

using testing::ElementsAre;

std::vector<std::string> headings_of(const ListedPart& part) {
  std::vector<std::string> headings;
  for (const ListedColumn& column : part.columns) headings.push_back(column.heading);
  return headings;
}

/// Two specimens beside each other, the second pulled to half the extension.
std::string two_beside_each_other() {
  std::string text = "Time,Force,Stroke,Time,Force,Stroke\nA,A,A,B,B,B\nsec,N,mm,sec,N,mm\n";
  for (int i = 0; i <= 60; ++i) text += fmt::format("{0},{1},{2:.3f},{0},{1},{3:.3f}\n", i, 10 * i, 0.02 * i, 0.01 * i);
  return text;
}

TEST(ExportList, EveryPartHasItsOwnColumnsUnitsAndRanges) {
  const auto held = list_export(two_beside_each_other(), "a.csv");
  ASSERT_TRUE(held) << held.error().reason;
  ASSERT_EQ(held->parts.size(), 2U);
  for (const ListedPart& part : held->parts) {
    EXPECT_THAT(headings_of(part), ElementsAre("Time", "Force", "Stroke"));
    EXPECT_EQ(part.rows, 61U);
    EXPECT_TRUE(part.columns[1].taken);
    EXPECT_EQ(part.columns[1].unit, "N");
    EXPECT_EQ(part.columns[1].quantity, "force");
    EXPECT_DOUBLE_EQ(part.columns[1].most, 600.0);
  }
  EXPECT_DOUBLE_EQ(held->parts[0].columns[2].most, 1.2);
  EXPECT_DOUBLE_EQ(held->parts[1].columns[2].most, 0.6);
}

TEST(ExportList, ASparklineRisesWithItsColumn) {
  const auto held = list_export(two_beside_each_other(), "a.csv");
  ASSERT_TRUE(held);
  const std::string& line = held->parts[0].columns[1].sparkline;
  EXPECT_TRUE(line.starts_with("▁"));
  EXPECT_TRUE(line.ends_with("█"));
}

TEST(ExportList, AFileWithoutATableIsAFaultThatNamesIt) {
  const auto held = list_export("a letter\nwithout numbers\n", "letter.txt");
  ASSERT_FALSE(held);
  EXPECT_EQ(held.error().file, "letter.txt");
}

}  // namespace
}  // namespace nacre::measurement
