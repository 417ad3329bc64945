#include "pattern/coupons.hpp"

#include <gtest/gtest.h>

#include "base/result.hpp"

namespace nacre::pattern {
namespace {

TEST(Laminate, LayersRunTheWayTheyAreNamed) {
  const Layout series = laminate(LayerDirection::along_x, 3, 2), parallel = laminate(LayerDirection::along_y, 3, 2);
  EXPECT_EQ(series.transposed(), parallel);
  EXPECT_DOUBLE_EQ(series.rigid_fraction(), 0.6);
  for (int c = 0; c < kSide; ++c) {
    EXPECT_TRUE(series.rigid(2, c));
    EXPECT_FALSE(series.rigid(3, c));
    EXPECT_TRUE(series.rigid(5, c));
  }
}

TEST(Checkerboard, NeighbouringSquaresDiffer) {
  for (const int period : {1, 2, 5, 10}) {
    const Layout board = checkerboard(period);
    EXPECT_DOUBLE_EQ(board.rigid_fraction(), 0.5);
    EXPECT_TRUE(board.rigid(0, 0));
    for (int r = 0; r < kSide; ++r) {
      for (int c = 0; c < kSide; ++c) {
        EXPECT_NE(board.rigid(r, c), board.rigid((r + period) % kSide, c));
        EXPECT_NE(board.rigid(r, c), board.rigid(r, (c + period) % kSide));
      }
    }
    EXPECT_FALSE(board.has_eightfold_symmetry());
  }
}

TEST(Coupons, PeriodsThatDoNotFitTheUnitAreRefused) {
  for (const int period : {-1, 0, 3, 4, 20}) EXPECT_THROW(checkerboard(period), InputError) << period;
  EXPECT_THROW(laminate(LayerDirection::along_x, 2, 1), InputError);
  EXPECT_THROW(laminate(LayerDirection::along_x, 0, 4), InputError);
  EXPECT_THROW(laminate(LayerDirection::along_x, -1, 3), InputError);
}

TEST(Coupons, NamesReadBack) {
  for (const char* name : {"checkerboard:1", "checkerboard:2", "checkerboard:5", "laminate:x:3:2", "laminate:y:1:1"}) {
    const auto layout = coupon_from_name(name);
    ASSERT_TRUE(layout && *layout) << name;
    EXPECT_EQ(coupon_name(**layout), name);
  }
  EXPECT_FALSE(coupon_from_name("577fffe9fffdef"));
  EXPECT_FALSE(coupon_name(Layout{}));
  for (const char* wrong : {"checkerboard:2147483647", "laminate:x:2147483647:3", "checkerboard:3", "checkerboard",
                            "laminate:z:1:1", "laminate:x:3:3", "laminate:x:1"}) {
    const auto refused = coupon_from_name(wrong);
    ASSERT_TRUE(refused) << wrong;
    EXPECT_FALSE(*refused) << wrong;
  }
}

}  // namespace
}  // namespace nacre::pattern
