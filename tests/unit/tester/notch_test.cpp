#include "tester/notch.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "../../grids.hpp"

namespace nacre::tester {
namespace {

int empty_in_row(const fem::Grid& grid, int row) {
  const auto start = grid.phase.begin() + row * grid.columns;
  return static_cast<int>(std::count(start, start + grid.columns, fem::Phase::empty));
}

TEST(Notch, FullSpecimenHasTheNotchOfTheThesis) {
  fem::Grid grid = fem::uniform_grid(200, 160);
  cut_notch(grid, 1);
  EXPECT_EQ(empty_in_row(grid, 80), 40);
  EXPECT_EQ(empty_in_row(grid, 79), empty_in_row(grid, 81)) << "the cut is symmetric about the notch";
  // One element off the axis the cut of 60 degrees is sqrt 3 elements shallower than its depth of 30.
  EXPECT_EQ(empty_in_row(grid, 81), 28);
  EXPECT_EQ(empty_in_row(grid, 80 + 17), 1) << "30 tan 30 = 17.3 elements high at the edge";
  EXPECT_EQ(empty_in_row(grid, 80 + 18), 0);
}

TEST(Notch, SmallerSpecimensKeepItsShareOfTheWidth) {
  fem::Grid grid = fem::uniform_grid(40, 40);
  cut_notch(grid, 1);
  EXPECT_EQ(empty_in_row(grid, 20), 8);
  EXPECT_EQ(empty_in_row(grid, 21), 4);
  EXPECT_EQ(empty_in_row(grid, 0), 0);
}

TEST(Notch, RefinedGridLosesTheSameArea) {
  fem::Grid coarse = fem::uniform_grid(80, 80), fine = fem::uniform_grid(240, 240);
  cut_notch(coarse, 1);
  cut_notch(fine, 3);
  for (int row = 0; row < 240; ++row) EXPECT_EQ(empty_in_row(fine, row), 3 * empty_in_row(coarse, row / 3)) << row;
}

}  // namespace
}  // namespace nacre::tester
