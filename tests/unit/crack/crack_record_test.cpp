// Synthetic orders of failing on small grids drawn as text.

#include "crack/crack_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "crack/distances.hpp"
#include "drawing.hpp"
#include "material/parameters.hpp"

namespace nacre::crack {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(CrackRecord, AStraightCrackIsAsLongAsTheColumnsItCrosses) {
  const CrackRecord record = drawn_record({"..........",  //
                                           "oooxxsiixx",  //
                                           ".........."});
  ASSERT_TRUE(record.path);
  EXPECT_DOUBLE_EQ(record.path->ratio(), 1.0);
  EXPECT_NEAR(record.path->length_m, 7 * kSize, 1e-15);
  EXPECT_THAT(record.path->elements, ElementsAre(13, 14, 15, 16, 17, 18, 19));
  EXPECT_TRUE(record.path->crosses);
  EXPECT_NEAR(record.path->bridged_share, 0.0, 1e-15);
  EXPECT_NEAR(record.path->material[0], 1.0 / 7, 1e-12);
  EXPECT_NEAR(record.path->material[1], 4.0 / 7, 1e-12);
  EXPECT_NEAR(record.path->material[2], 2.0 / 7, 1e-12);
  EXPECT_EQ(record.branches, 0);
  EXPECT_EQ(record.separate_cracks, 0);
}

TEST(CrackRecord, ADeflectedCrackIsLongerByItsSlope) {
  const CrackRecord record = drawn_record({"........x.",  //
                                           ".......x..",  //
                                           "......x...",  //
                                           ".....x....",  //
                                           "....x.....",  //
                                           "ooox......"});
  EXPECT_NEAR(record.path->length_m, (5 * std::sqrt(2.0) + 1) * kSize, 1e-12);
  EXPECT_NEAR(record.path->straight_length_m, 6 * kSize, 1e-12);
  EXPECT_FALSE(record.path->crosses);
  EXPECT_EQ(record.branches, 0);
}

TEST(CrackRecord, AStepAlongThePullCountsWithItsHeight) {
  const CrackRecord record = drawn_record({".....xxxxx",  //
                                           ".....x....",  //
                                           ".....x....",  //
                                           ".....x....",  //
                                           "oooxxx...."});
  // Corners are cut: 3 -> 4 -> diagonal -> up 2 -> diagonal -> on.
  EXPECT_NEAR(record.path->length_m, (1 + std::sqrt(2.0) + 2 + std::sqrt(2.0) + 3 + 1) * kSize, 1e-12);
  EXPECT_NEAR(record.path->straight_length_m, 7 * kSize, 1e-12);
}

TEST(CrackRecord, ALongBranchCountsAShortOneDoesNot) {
  const auto fork = [](int height) {
    std::vector<std::string> lines(10, std::string(20, '.'));
    for (int column = 0; column < 20; ++column) lines[9][column] = column < 4 ? 'o' : 'x';
    for (int i = 1; i <= height; ++i) lines[9 - i][10] = 'x';
    return lines;
  };
  EXPECT_EQ(drawn_record(fork(5)).branches, 0);
  EXPECT_EQ(drawn_record(fork(6)).branches, 1);
  EXPECT_DOUBLE_EQ(drawn_record(fork(9)).path->ratio(), 1.0);
  auto both_sides = fork(8);
  const auto upper = both_sides;
  both_sides.insert(both_sides.end(), upper.rbegin() + 1, upper.rend());
  EXPECT_EQ(drawn_record(both_sides).branches, 2);
}

TEST(CrackRecord, ABranchThatForksCountsTwice) {
  std::vector<std::string> lines(24, std::string(40, '.'));
  for (std::size_t column = 0; column < 40; ++column) lines[23][column] = column < 4 ? 'o' : 'x';
  for (std::size_t i = 1; i <= 10; ++i) lines[23 - i][20] = 'x';
  for (std::size_t i = 1; i <= 8; ++i) lines[13 - i][20 - i] = lines[13 - i][20 + i] = 'x';
  EXPECT_EQ(drawn_record(lines).branches, 2);
}

TEST(CrackRecord, AThickCrackHasNoBranches) {
  std::vector<std::string> lines(9, "....................");
  for (std::size_t row = 2; row < 7; ++row) lines[row] = row == 4 ? "ooooxxxxxxxxxxxxxxxx" : "....xxxxxxxxxxxxxxxx";
  EXPECT_EQ(drawn_record(lines).branches, 0);
}

TEST(CrackRecord, TwoDisjointCracksAreBridgedOnThePathAndCountedApart) {
  const std::vector<std::string> lines = {"....................",  //
                                          "..........xxxxxxxxxx",  //
                                          "....................",  //
                                          "....................",  //
                                          "oooxxxxxx..........."};
  const CrackRecord record = drawn_record(lines);
  EXPECT_TRUE(record.path->crosses);
  EXPECT_GT(record.path->bridged_share, 0.05);
  EXPECT_LT(record.path->bridged_share, 0.25);
  EXPECT_GT(record.path->ratio(), 1.0);
  EXPECT_EQ(record.separate_cracks, 0) << "the path takes both";

  std::vector<std::string> apart = lines;
  apart[1] = "....................";
  apart[4] = "oooxxxxxxxxxxxxxxxxx";
  apart[0] = "....xxxx....xxx.....";
  const CrackRecord separate = drawn_record(apart);
  EXPECT_NEAR(separate.path->bridged_share, 0.0, 1e-15);
  EXPECT_EQ(separate.separate_cracks, 1) << "three elements are no crack yet";
}

TEST(CrackRecord, OfEquallyLongWaysTheOneThatFailedFirstIsThePath) {
  const Drawing drawing = draw({"...xxx....",  //
                                "oox...xxxx",  //
                                "...xxx...."});
  const auto in_row = [&](const CrackRecord& record, int row) {
    return std::any_of(record.path->elements.begin(), record.path->elements.end(),
                       [&](int e) { return e / drawing.grid.columns == row; });
  };
  for (const int late_row : {0, 2}) {
    auto order = drawing.order;
    for (tester::Break& broken : order)
      if (broken.element / drawing.grid.columns == late_row) broken.strain += 1e-3;
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.strain < b.strain; });
    const CrackRecord record = crack_record(drawing.grid, order);
    EXPECT_FALSE(in_row(record, late_row));
    EXPECT_TRUE(in_row(record, 2 - late_row));
  }
}

TEST(CrackRecord, WithoutFailedElementsThereIsNoPath) {
  const CrackRecord record = drawn_record({"....", "oo..", "...."});
  EXPECT_FALSE(record.path);
  EXPECT_THAT(record.order, IsEmpty());
  EXPECT_EQ(record.branches, 0);
}

TEST(CrackRecord, WithoutANotchThePathBeginsFarthestLeft) {
  const CrackRecord record = drawn_record({"......", "..xxx.", "......"});
  EXPECT_THAT(record.path->elements, ElementsAre(8, 9, 10));
  EXPECT_DOUBLE_EQ(record.path->ratio(), 1.0);
}

/// Laws on scattered failures, which no drawing thinks of: seeded, clustered about a line.
Drawing scattered(unsigned seed) {
  Drawing drawing = draw(std::vector<std::string>(31, std::string(40, '.')));
  fem::Grid& grid = drawing.grid;
  for (int column = 0; column < 8; ++column) grid.phase[grid.index(15, column)] = fem::Phase::empty;
  std::mt19937 random(seed);
  std::vector<bool> failed(grid.element_count(), false);
  for (int i = 0; i < 150; ++i) {
    const int column = static_cast<int>(random() % 32) + 8, row = 15 + static_cast<int>(random() % 9) - 4;
    const auto e = static_cast<std::size_t>(grid.index(row, column));
    grid.phase[e] = static_cast<fem::Phase>(random() % 3);
    if (!failed[e]) drawing.order.push_back({static_cast<int>(e), 0.01 + 1e-4 * i});
    failed[e] = true;
  }
  return drawing;
}

TEST(CrackRecord, MirroringTheSpecimenMirrorsTheRecord) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    const Drawing drawing = scattered(seed);
    Drawing mirrored = drawing;
    const auto mirror = [&](int e) {
      const int row = e / drawing.grid.columns, column = e % drawing.grid.columns;
      return drawing.grid.index(drawing.grid.rows - 1 - row, column);
    };
    for (int e = 0; e < drawing.grid.element_count(); ++e) mirrored.grid.phase[mirror(e)] = drawing.grid.phase[e];
    for (tester::Break& broken : mirrored.order) broken.element = mirror(broken.element);
    const CrackRecord a = crack_record(drawing.grid, drawing.order), b = crack_record(mirrored.grid, mirrored.order);
    std::vector<int> path = a.path->elements;
    std::transform(path.begin(), path.end(), path.begin(), mirror);
    EXPECT_EQ(path, b.path->elements);
    EXPECT_EQ(a.path->ratio(), b.path->ratio());
    EXPECT_EQ(a.path->material, b.path->material);
    EXPECT_EQ(a.branches, b.branches);
    EXPECT_EQ(a.separate_cracks, b.separate_cracks);
  }
}

TEST(CrackRecord, NoPathIsShorterThanStraightAndSharesAddUp) {
  for (unsigned seed = 10; seed < 60; ++seed) {
    const Drawing drawing = scattered(seed);
    const CrackPath path = crack_record(drawing.grid, drawing.order).path.value();
    EXPECT_GE(path.ratio(), 1.0);
    EXPECT_NEAR(path.material[0] + path.material[1] + path.material[2], 1.0, 1e-12);
    EXPECT_GE(path.bridged_share, 0.0);
    EXPECT_LT(path.bridged_share, 1.0);
    for (std::size_t i = 1; i < path.elements.size(); ++i)
      EXPECT_LE(step_length(drawing.grid, path.elements[i - 1], path.elements[i]), std::sqrt(2.0));
  }
}

TEST(CrackRecord, OfASimulatedSpecimenRunsFromTheNotch) {
  const tester::Simulation simulation{pattern::Mixture{1.0}, material::thesis_parameters(), {}, tester::Fidelity::tiny};
  const tester::ToughnessResult result = tester::test_toughness(simulation).value();
  const CrackRecord record = record_of(simulation, result.breaks);
  EXPECT_EQ(record.columns, 40);
  EXPECT_EQ(record.rows, 40);
  ASSERT_TRUE(record.path);
  EXPECT_TRUE(record.path->crosses) << "a brittle specimen separates";
  EXPECT_LT(record.path->ratio(), 1.3) << "and straight ahead";
  EXPECT_LE(record.path->elements.front() % record.columns, 9) << "the notch is 8 elements long";
  EXPECT_NEAR(record.path->material[1], 1.0, 1e-12) << "rigid alone";
}

TEST(Distances, AreThoseOfTheEightNeighbours) {
  fem::Grid grid;
  grid.columns = 5;
  grid.rows = 4;
  const Distances distances = distances_from(grid, {0}, [](int) { return 1.0; });
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 5; ++column) {
      const int diagonal = std::min(row, column), straight = std::max(row, column) - diagonal;
      EXPECT_NEAR(distances.cost[grid.index(row, column)], straight + diagonal * std::sqrt(2.0), 1e-12);
    }
}

}  // namespace
}  // namespace nacre::crack
