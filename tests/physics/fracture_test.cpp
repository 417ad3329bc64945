// The toughness tester as a whole: rigid motions and frames. Energies, symmetries, bits, knobs and blow-up have files
// of their own.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "specimens.hpp"

namespace nacre {
namespace {

using verification::patterns;
using verification::specimen;

/// Mean sideways displacement of all nodes over the grip's displacement, largest magnitude over a test.
double largest_sideways_drift(const tester::FractureTest& test, std::int64_t steps) {
  auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
  const int nodes = (test.grid.columns + 1) * (test.grid.rows + 1);
  double largest = 0.0;
  for (std::int64_t step = 1; step <= steps; ++step) {
    if (!solver.step()) return 1.0;
    if (step % 50 != 0) continue;
    double mean = 0.0;
    for (int node = 0; node < nodes; ++node) mean += solver.displacement_m(node).x() / nodes;
    largest = std::max(largest, std::abs(mean) / (solver.strain() * test.grid.rows * test.grid.element_size_m));
  }
  return largest;
}

// Nothing holds the specimen sideways, and no force pushes it. A symmetric one stays where it is to rounding; with
// notch and crack the filter, which leaves out the border and so keeps momentum only inside, moves it by less than 2 %
// of the grip.
TEST(Fracture, FreeSidewaysMotionStaysUnexcited) {
  const tester::FractureTest notched = tester::fracture_test(specimen(patterns(1)[0]));
  EXPECT_LT(largest_sideways_drift(notched, tester::run_fracture_test<float>(notched).value().steps), 0.02);
  tester::FractureTest whole = tester::fracture_test(specimen(pattern::Mixture{1.0}));
  std::fill(whole.grid.phase.begin(), whole.grid.phase.end(), fem::Phase::rigid);
  std::fill(whole.grid.young_pa.begin(), whole.grid.young_pa.end(), whole.grid.young_pa.back());
  std::fill(whole.grid.poisson.begin(), whole.grid.poisson.end(), whole.grid.poisson.back());
  EXPECT_LT(largest_sideways_drift(whole, 10000), 1e-6);
}

TEST(Fracture, FramesShowTheCrackGrowAndChangeNoNumber) {
  const tester::Simulation simulation = specimen(patterns(1)[0]);
  const auto result = tester::test_toughness(simulation, {.frame_count = 12}).value();
  const auto unfilmed = tester::test_toughness(simulation).value();
  EXPECT_EQ(result.toughness_pa, unfilmed.toughness_pa);
  EXPECT_EQ(result.breaks, unfilmed.breaks);
  EXPECT_TRUE(unfilmed.frames.empty());
  ASSERT_EQ(result.frames.size(), 12u);
  const auto void_count = [](const tester::FractureFrame& frame) {
    return std::count(frame.material.begin(), frame.material.end(), 3);
  };
  for (const tester::FractureFrame& frame : result.frames) {
    ASSERT_EQ(frame.energy_j_per_m3.size(), 1600u);
    ASSERT_EQ(frame.displacement_m.size(), 2u * 41u * 41u);
    const auto broken = std::count_if(result.breaks.begin(), result.breaks.end(),
                                      [&](const tester::Break& b) { return b.strain < frame.strain; });
    EXPECT_EQ(void_count(frame), void_count(result.frames[0]) + broken) << "what has failed before the frame is empty";
    const double height_m = 40 * frame.element_size_m;
    EXPECT_NEAR(frame.displacement_m.back(), frame.strain * height_m, 1e-6 * height_m) << "the upper grip moves";
  }
  EXPECT_NEAR(result.frames.back().strain, result.failure_strain, 1e-12);
  EXPECT_GT(result.breaks.size(), 20u);
}

}  // namespace
}  // namespace nacre
