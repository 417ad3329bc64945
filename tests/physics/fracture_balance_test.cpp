// Bookkeeping of the toughness tester: energy and momentum, step by step, through the whole of a fracture test.

#include <cmath>

#include <gtest/gtest.h>

#include "specimens.hpp"

namespace nacre {
namespace {

using verification::patterns;
using verification::specimen;

/// Error of the ledger relative to everything given so far.
double imbalance(const fem::EnergyLedger& ledger) {
  const double given = ledger.work + ledger.initial_kinetic + ledger.initial_stored;
  return (ledger.kinetic + ledger.stored + ledger.damped + ledger.fractured) / given - 1.0;
}

// Work of the grips = growth of kinetic and stored energy + damping + energy of failed elements: within 1 % at every
// moment from a tenth of the test on, and within 0.5 % before the first element fails.
TEST(FractureBalance, EnergyIsAccountedForThroughSeparation) {
  for (const pattern::Design& design : {patterns(1)[0], patterns(2)[1], pattern::Design(pattern::Mixture{1.0})}) {
    tester::FractureTest test = tester::fracture_test(specimen(design));
    const std::int64_t steps = tester::run_fracture_test<float>(test).value().steps;
    test.settings.keep_ledger = true;
    auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
    int failed = 0;
    double worst = 0.0, worst_before_failure = 0.0;
    for (std::int64_t step = 1; step <= steps; ++step) {
      failed += solver.step().value().failed;
      if (step < steps / 10 || (step % 200 != 0 && step != steps)) continue;
      const double error = std::abs(imbalance(solver.ledger()));
      worst = std::max(worst, error);
      if (failed == 0) worst_before_failure = std::max(worst_before_failure, error);
    }
    EXPECT_GT(failed, 20) << "a crack should have run";
    const fem::EnergyLedger ledger = solver.ledger();
    EXPECT_GT(ledger.fractured, 0.05 * ledger.work);
    EXPECT_GT(ledger.damped, 0.0);
    EXPECT_LT(worst, 0.01) << design.name();
    EXPECT_LT(worst_before_failure, 5e-3) << design.name();
  }
}

// Keeping the ledger only reads: the specimen moves as it does without.
TEST(FractureBalance, KeepingTheLedgerChangesNoBit) {
  tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  const tester::ToughnessResult plain = tester::run_fracture_test<float>(test).value();
  test.settings.keep_ledger = true;
  const tester::ToughnessResult watched = tester::run_fracture_test<float>(test).value();
  EXPECT_EQ(watched.curve, plain.curve);
  EXPECT_EQ(watched.toughness_pa, plain.toughness_pa);
}

/// Momentum of all nodes but the grips', in the vertical, and of all nodes sideways, kg m/s per unit thickness.
template <class Real>
Eigen::Vector2d momentum(const fem::ExplicitSolver<Real>& solver, const tester::FractureTest& test) {
  const int per_row = test.grid.columns + 1;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int node = 0; node < per_row * (test.grid.rows + 1); ++node) {
    const Eigen::Vector2d velocity = solver.velocity_m_per_s(node);
    const bool grip = node < per_row || node >= per_row * test.grid.rows;
    sum += Eigen::Vector2d(velocity.x(), grip ? 0.0 : velocity.y());
  }
  return sum * (test.settings.density_kg_per_m3 * std::pow(test.grid.element_size_m, 2));
}

struct MomentumErrors {
  double vertical = 0.0;  ///< momentum - impulse of the grips, largest over the test, over the impulse of one grip
  double sideways = 0.0;  ///< momentum sideways, likewise
  int failed = 0;
};

template <class Real>
MomentumErrors momentum_errors(const tester::FractureTest& test, int steps) {
  auto solver = fem::ExplicitSolver<Real>::create(test.grid, test.settings).value();
  const double area_per_step = test.grid.columns * test.grid.element_size_m * test.settings.time_step_s;
  const Eigen::Vector2d start = momentum(solver, test);
  double impulse = 0.0, magnitude = 0.0;
  MomentumErrors errors;
  for (int step = 1; step <= steps; ++step) {
    const fem::StepReport report = solver.step().value();
    impulse += (report.top_stress_pa - report.bottom_stress_pa) * area_per_step;
    magnitude += std::abs(report.top_stress_pa) * area_per_step;
    errors.failed += report.failed;
    if (step % 100 != 0) continue;
    const Eigen::Vector2d gained = momentum(solver, test) - start;
    errors.vertical = std::max(errors.vertical, std::abs(gained.y() - impulse) / magnitude);
    errors.sideways = std::max(errors.sideways, std::abs(gained.x()) / magnitude);
  }
  return errors;
}

// Elements push and pull equally on their nodes, failing or not: without damping the momentum of what lies between the
// grips is their impulse, in double to rounding (1e-11 of a grip's impulse), in single to 1e-4 of it.
TEST(FractureBalance, MomentumIsTheImpulseOfTheGrips) {
  tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  test.settings.gamma_per_s = 0.0;
  test.settings.strain_rate_per_s *= 4.0;
  const MomentumErrors exact = momentum_errors<double>(test, 6000), single = momentum_errors<float>(test, 6000);
  EXPECT_GT(exact.failed, 20) << "a crack should have run";
  EXPECT_LT(exact.vertical, 1e-11);
  EXPECT_LT(exact.sideways, 1e-11);
  EXPECT_LT(single.vertical, 1e-4);
  EXPECT_LT(single.sideways, 1e-4);
}

// The filter (2.4) leaves out the border of the grid, so that it keeps momentum inside only. What it takes or gives
// stays below 2 % of a grip's impulse at the default damping.
TEST(FractureBalance, TheFilterHardlyTouchesMomentum) {
  const MomentumErrors errors = momentum_errors<double>(tester::fracture_test(specimen(patterns(2)[1])), 20000);
  EXPECT_LT(errors.vertical, 0.02);
  EXPECT_LT(errors.sideways, 0.02);
}

}  // namespace
}  // namespace nacre
