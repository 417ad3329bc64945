// The toughness tester as a whole: energies, symmetry, independence of instruction set and thread, precision,
// recording, and what happens when a solution blows up. Specimens are `tiny` (40 x 40 elements) unless a test says
// otherwise.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"

namespace nacre {
namespace {

tester::Simulation specimen(const pattern::Design& design, tester::Fidelity fidelity = tester::Fidelity::tiny) {
  return {.design = design, .parameters = material::default_parameters(), .conditions = {}, .fidelity = fidelity};
}

/// published_a and random patterns of 50 to 85 % rigid pixels.
std::vector<pattern::Design> patterns(int count) {
  std::vector<pattern::Design> designs = {pattern::design_from_name("577fffe9fffdef").value()};
  RandomStream random(1, "fracture test");
  while (static_cast<int>(designs.size()) < count) designs.emplace_back(pattern::random_pattern(random));
  return designs;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Relative differences of T between two ways of running the same specimens.
template <class A, class B>
std::vector<double> toughness_differences(const std::vector<pattern::Design>& designs, const A& a, const B& b) {
  std::vector<double> differences(designs.size());
  parallel_for(static_cast<int>(designs.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    const double first = a(specimen(designs[at])).value().toughness_pa,
                 second = b(specimen(designs[at])).value().toughness_pa;
    differences[at] = std::abs(first / second - 1.0);
  });
  return differences;
}

// Work of the grips = growth of kinetic and stored energy + damping + energy of failed elements, within 1 % of the
// work.
TEST(Fracture, EnergyIsAccountedForThroughSeparation) {
  for (const pattern::Design& design : {patterns(1)[0], pattern::Design(pattern::Mixture{1.0})}) {
    tester::FractureTest test = tester::fracture_test(specimen(design));
    test.settings.keep_ledger = true;
    auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
    const std::int64_t steps = tester::run_fracture_test<float>(test).value().steps;
    int failed = 0;
    for (std::int64_t step = 0; step < steps; ++step) failed += solver.step().value().failed;
    EXPECT_GT(failed, 20) << "a crack should have run";
    const fem::EnergyLedger ledger = solver.ledger();
    EXPECT_GT(ledger.fractured, 0.05 * ledger.work);
    EXPECT_GT(ledger.damped, 0.0);
    const double given = ledger.work + ledger.initial_kinetic + ledger.initial_stored;
    const double found = ledger.kinetic + ledger.stored + ledger.damped + ledger.fractured;
    EXPECT_NEAR(found / given, 1.0, 0.01) << design.name();
  }
}

/// The grid with its columns (or rows) in reverse order.
fem::Grid mirrored(const fem::Grid& grid, bool columns) {
  fem::Grid result = grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int from = columns ? grid.index(row, grid.columns - 1 - column) : grid.index(grid.rows - 1 - row, column);
      const int to = grid.index(row, column);
      result.phase[to] = grid.phase[from];
      result.young_pa[to] = grid.young_pa[from];
      result.poisson[to] = grid.poisson[from];
      result.threshold_j_per_m3[to] = grid.threshold_j_per_m3[from];
    }
  return result;
}

// The kernel forms its sums so that mirrored specimens have mirrored bits; the reactions are summed in another order,
// in double.
TEST(Fracture, MirroringTheModelMirrorsTheResult) {
  const tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  const tester::ToughnessResult plain = tester::run_fracture_test<float>(test).value();
  for (const bool columns : {true, false}) {
    tester::FractureTest turned = test;
    turned.grid = mirrored(test.grid, columns);
    const tester::ToughnessResult mirror = tester::run_fracture_test<float>(turned).value();
    EXPECT_EQ(mirror.steps, plain.steps);
    EXPECT_NEAR(mirror.toughness_pa / plain.toughness_pa, 1.0, 1e-10);
  }
}

// The same bits from every instruction set this machine has; the wide ones on a whole test, the slow baseline on its
// start.
TEST(Fracture, InstructionSetsGiveTheSameBits) {
  tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  std::vector<tester::ToughnessResult> results;
  for (const fem::SimdLevel level : {fem::SimdLevel::avx2, fem::SimdLevel::avx512}) {
    if (!fem::has_simd_level(level)) continue;
    test.settings.simd = level;
    results.push_back(tester::run_fracture_test<float>(test).value());
    EXPECT_EQ(results.back().curve, results.front().curve);
    EXPECT_EQ(results.back().toughness_pa, results.front().toughness_pa);
  }
  // The baseline has to agree from before the first failure until after the crack has run.
  test.settings.strain_rate_per_s *= 4.0;
  std::vector<std::vector<double>> stresses;
  for (const fem::SimdLevel level : {fem::SimdLevel::baseline, fem::SimdLevel::avx2, fem::SimdLevel::avx512}) {
    if (!fem::has_simd_level(level)) continue;
    test.settings.simd = level;
    auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
    int failed = 0;
    stresses.emplace_back();
    for (int step = 0; step < 4000; ++step) {
      const fem::StepReport report = solver.step().value();
      stresses.back().push_back(report.top_stress_pa);
      stresses.back().push_back(report.bottom_stress_pa);
      failed += report.failed;
    }
    EXPECT_GT(failed, 10);
    EXPECT_EQ(stresses.back(), stresses.front()) << fem::to_string(level);
  }
}

TEST(Fracture, ThreadsGiveTheSameBits) {
  const tester::Simulation simulation = specimen(patterns(3)[2]);
  const tester::ToughnessResult alone = tester::test_toughness(simulation).value();
  std::vector<tester::ToughnessResult> together(3);
  parallel_for(
      3, [&](int i) { together[static_cast<std::size_t>(i)] = tester::test_toughness(simulation).value(); }, 3);
  for (const tester::ToughnessResult& result : together) {
    EXPECT_EQ(result.curve, alone.curve);
    EXPECT_EQ(result.toughness_pa, alone.toughness_pa);
    EXPECT_EQ(result.steps, alone.steps);
  }
}

// Median over patterns: which element fails first may turn on the last bit, so single specimens may differ by more.
TEST(Fracture, SingleAndDoublePrecisionAgree) {
  const std::vector<double> differences = toughness_differences(
      patterns(7), [](const auto& s) { return tester::run_fracture_test<float>(tester::fracture_test(s)); },
      [](const auto& s) { return tester::run_fracture_test<double>(tester::fracture_test(s)); });
  EXPECT_LT(median(differences), 0.01);
}

TEST(Fracture, HalfTheTimeStepChangesLittle) {
  const std::vector<double> differences = toughness_differences(
      patterns(7), [](const auto& s) { return tester::test_toughness(s); },
      [](const auto& s) { return tester::test_toughness(s, {.time_step_scale = 0.5}); });
  EXPECT_LT(median(differences), 0.02);
}

// The area is that of every step, so what recording can change is the curve: its area stays within 0.1 % of T.
TEST(Fracture, DoubledRecordingChangesToughnessByLessThanAThousandth) {
  for (const pattern::Design& design : patterns(3)) {
    const auto once = tester::test_toughness(specimen(design)).value();
    const auto twice = tester::test_toughness(specimen(design), {.recording_scale = 2}).value();
    EXPECT_GT(twice.curve.size(), once.curve.size() * 9 / 5);
    EXPECT_NEAR(area_under(twice.curve) / area_under(once.curve), 1.0, 1e-3);
    EXPECT_NEAR(area_under(once.curve) / once.toughness_pa, 1.0, 1e-3);
    EXPECT_EQ(once.toughness_pa, twice.toughness_pa);
  }
}

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

TEST(Fracture, BlowUpIsReportedWithStepAndElement) {
  tester::FractureTest test = tester::fracture_test(specimen(pattern::Mixture{1.0}));
  for (double& threshold : test.grid.threshold_j_per_m3) threshold = 1e300;
  test.settings.largest_courant_number = 10.0;
  test.settings.time_step_s = 1.6 * test.grid.element_size_m / fem::fastest_wave_m_per_s(test.grid, 1150.0);
  const auto result = tester::run_fracture_test<float>(test);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, testing::HasSubstr("blew up"));
  EXPECT_THAT(result.error().message, testing::ContainsRegex("element row [0-9]+ column [0-9]+ at step [0-9]+"));
}

TEST(Fracture, TimeStepBeyondStabilityIsRefused) {
  const auto result = tester::test_toughness(specimen(pattern::Mixture{1.0}), {.time_step_scale = 1.3});
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, testing::HasSubstr("stability limit"));
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
