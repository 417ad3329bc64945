#include "crack/marks.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawing.hpp"

namespace nacre::crack {
namespace {

std::vector<Mark> drawn(const std::vector<std::string>& lines) {
  const Drawing drawing = draw(lines);
  return marks_of(drawing.grid, crack_record(drawing.grid, drawing.order));
}

std::vector<Mark> of_kind(std::vector<Mark> marks, MarkKind kind) {
  std::erase_if(marks, [&](const Mark& mark) { return mark.kind != kind; });
  return marks;
}

TEST(Marks, AStraightCrackThroughRigidMaterialHasNone) {
  EXPECT_TRUE(drawn({"..........", "ooxxxxxxxx", ".........."}).empty());
  EXPECT_TRUE(drawn({"....", "oo..", "...."}).empty()) << "nothing failed";
}

TEST(Marks, ADetourIsMarkedAtItsFarthestPointWhenTheCrackGetsThere) {
  const std::vector<std::string> detour = {"......x......", ".....x.x.....", "....x...x....",
                                           "...x.....x...", "..x.......x..", "oo.........xx"};
  const auto marks = of_kind(drawn(detour), MarkKind::deflection);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].element, 5 * 13 + 6);
  EXPECT_NEAR(marks[0].strain, 0.016, 1e-12);
}

TEST(Marks, ALigamentIsMarkedOnceTheCrackHasPassedIt) {
  const auto marks = of_kind(drawn({"..........", "ooxx..xxxx", ".........."}), MarkKind::bridging);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].element, 10 + 5);
  EXPECT_NEAR(marks[0].strain, 0.016, 1e-12) << "the first element behind it";
}

TEST(Marks, ArrestIsShownWhileTheTipWaits) {
  Drawing drawing = draw({"..........", "ooxxsxxxxx", ".........."});
  for (tester::Break& broken : drawing.order)
    if (broken.element % 10 >= 4) broken.strain += 0.007;
  const auto marks = of_kind(marks_of(drawing.grid, crack_record(drawing.grid, drawing.order)), MarkKind::soft_arrest);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].element, 14);
  EXPECT_NEAR(marks[0].strain, 0.013, 1e-12);
  EXPECT_NEAR(marks[0].until_strain, 0.021, 1e-12);
}

TEST(Marks, AGuidedStretchIsMarkedInItsMiddleAndAShortOneNot) {
  const auto marks = of_kind(drawn({"............", "ooxxssssiixx", "............"}), MarkKind::guidance);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].element, 12 + 7);
  EXPECT_TRUE(of_kind(drawn({"..........", "ooxxssixxx", ".........."}), MarkKind::guidance).empty());
}

TEST(Marks, BranchesAreAsManyAsTheRecordCounts) {
  const std::vector<std::string> fork = {"..........xx..", ".........x....", "........x.....",
                                         ".......x......", "......x.......", ".....x........",
                                         "....x.........", "...x..........", "ooxxxxxxxxxxxx"};
  const CrackRecord record = drawn_record(fork);
  EXPECT_GT(record.branches, 0);
  EXPECT_EQ(of_kind(drawn(fork), MarkKind::branching).size(), static_cast<std::size_t>(record.branches));
}

}  // namespace
}  // namespace nacre::crack
