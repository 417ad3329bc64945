#include "crack/mechanisms.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawing.hpp"

namespace nacre::crack {
namespace {

Mechanisms mechanisms_of(const std::vector<std::string>& lines) {
  const Drawing drawing = draw(lines);
  return mechanisms_of(drawing.grid, crack_record(drawing.grid, drawing.order));
}

TEST(Mechanisms, AStraightCrackThroughRigidMaterialShowsNone) {
  const Mechanisms none = mechanisms_of({"..........", "ooxxxxxxxx", ".........."});
  for (const double value : values_of(none)) EXPECT_NEAR(value, 0.0, 1e-12);
  for (const double value : values_of(mechanisms_of({"....", "oo..", "...."})))
    EXPECT_EQ(value, 0.0) << "nothing failed";
}

TEST(Mechanisms, ADetourIsDeflection) {
  const Mechanisms detour = mechanisms_of({"...xxx....", "..x...x...", "oo.....xxx"});
  EXPECT_GT(detour.deflection, 0.05);
  EXPECT_NEAR(detour.deflection, mechanisms_of({"oo.....xxx", "..x...x...", "...xxx...."}).deflection, 1e-12)
      << "up or down";
}

TEST(Mechanisms, StandingElementsInThePathAreBridges) {
  EXPECT_NEAR(mechanisms_of({"..........", "ooxx..xxxx", ".........."}).bridging, 2.0 / 8, 1e-9);
}

TEST(Mechanisms, ACrackBesideThePathIsBranching) {
  EXPECT_EQ(mechanisms_of({"....xxxxx.", "..........", "..........", "ooxxxxxxxx", ".........."}).branching, 1.0);
}

TEST(Mechanisms, WaitingInFrontOfSoftMaterialIsArrest) {
  Drawing drawing = draw({"..........", "ooxxsxxxxx", ".........."});
  const auto soft_arrest = [&] {
    return mechanisms_of(drawing.grid, crack_record(drawing.grid, drawing.order)).soft_arrest;
  };
  EXPECT_NEAR(soft_arrest(), 1.0 / 7, 1e-9) << "every column takes as long as the other";
  for (tester::Break& broken : drawing.order)
    if (broken.element % 10 >= 4) broken.strain += 0.007;  // the soft element holds for as long as all others together
  EXPECT_NEAR(soft_arrest(), 8.0 / 14, 1e-9);
}

TEST(Mechanisms, SoftMaterialAtTheNotchThatFailsLastIsArrestToo) {
  Drawing drawing = draw({"..........", "oosxxxxxxx", ".........."});
  double last = 0.0;
  for (const tester::Break& broken : drawing.order) last = std::max(last, broken.strain);
  for (tester::Break& broken : drawing.order)
    if (broken.element % 10 == 2) broken.strain = 2.0 * last;
  EXPECT_NEAR(mechanisms_of(drawing.grid, crack_record(drawing.grid, drawing.order)).soft_arrest, 1.0, 1e-9);
}

TEST(Mechanisms, APathThatSeeksWeakElementsIsGuided) {
  EXPECT_GT(mechanisms_of({"..........", "ooxxsssiii", ".........."}).guidance, 0.5);
  Drawing shunning = draw({"ssssssssss", "ooxxxxxxxx", ".........."});
  std::erase_if(shunning.order, [](const tester::Break& broken) { return broken.element >= 20; });
  EXPECT_LT(mechanisms_of(shunning.grid, crack_record(shunning.grid, shunning.order)).guidance, -0.3);
}

}  // namespace
}  // namespace nacre::crack
