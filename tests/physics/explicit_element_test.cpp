// The explicit solver's elements against closed forms: no force where there is none, the neo-Hookean law to finite
// strain, failure where the closed-form energy density reaches the threshold.

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "../grids.hpp"
#include "fem/explicit_solver.hpp"
#include "material/neo_hookean.hpp"

namespace nacre {
namespace {

constexpr double kYoung = 1e8, kPoisson = 0.35, kDensity = 1150.0, kElementSize = 260e-6;

fem::Grid homogeneous_grid(int columns, int rows, double threshold = std::numeric_limits<double>::infinity()) {
  return fem::uniform_grid(columns, rows, {kYoung, kPoisson, threshold});
}

double stable_step(const fem::Grid& grid) {
  return 0.8 * grid.element_size_m / fem::fastest_wave_m_per_s(grid, kDensity);
}

/// Accelerations, m/s^2, of all nodes of a homogeneous grid under the displacement u = gradient X, over the
/// acceleration E / (rho h) that a strain of order one would cause at a boundary; nodes are visited as (row, column,
/// value).
template <class Real, class Visit>
void visit_accelerations(const Eigen::Matrix2d& gradient, const Visit& visit) {
  const fem::Grid grid = homogeneous_grid(21, 13);
  const double dt = stable_step(grid);
  auto solver =
      fem::ExplicitSolver<Real>::create(grid, {.density_kg_per_m3 = kDensity, .time_step_s = dt, .simd = {}}).value();
  const auto node_of = [&](int row, int column) { return row * (grid.columns + 1) + column; };
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column)
      solver.set_node(node_of(row, column), gradient * kElementSize * Eigen::Vector2d(column, row),
                      Eigen::Vector2d::Zero());
  ASSERT_TRUE(solver.step());
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column)
      visit(row, column,
            (solver.velocity_m_per_s(node_of(row, column)) / dt).norm() / (kYoung / (kDensity * kElementSize)));
}

Eigen::Matrix2d finite_gradient() {
  Eigen::Matrix2d gradient;
  gradient << -0.05, 0.12, 0.07, 0.25;
  return gradient;
}

/// Rotation by 30 degrees, minus the unit matrix.
Eigen::Matrix2d rotation_gradient() {
  const double angle = std::numbers::pi / 6.0;
  Eigen::Matrix2d gradient;
  gradient << std::cos(angle) - 1.0, -std::sin(angle), std::sin(angle), std::cos(angle) - 1.0;
  return gradient;
}

// Patch test: a uniform finite gradient leaves every inner node in equilibrium, to rounding of the displacements (some
// 20 elements, each 1e-16 or 6e-8 of that).
TEST(ExplicitElement, UniformGradientLeavesInnerNodesInEquilibrium) {
  double largest_double = 0.0, largest_single = 0.0, at_boundary = 0.0;
  const auto inner = [](int row, int column) { return row > 0 && row < 13 && column > 0 && column < 21; };
  visit_accelerations<double>(finite_gradient(), [&](int row, int column, double value) {
    double& largest = inner(row, column) ? largest_double : at_boundary;
    largest = std::max(largest, value);
  });
  visit_accelerations<float>(finite_gradient(), [&](int row, int column, double value) {
    if (inner(row, column)) largest_single = std::max(largest_single, value);
  });
  EXPECT_LT(largest_double, 1e-13);
  EXPECT_LT(largest_single, 3e-5);
  EXPECT_GT(at_boundary, 0.01) << "the gradient should load the boundary";
}

/// Tractions that a uniform displacement gradient calls for, taken from one step of the solver: on the left side from
/// the acceleration of a node, on top from that (horizontal) and the grip's reaction (vertical). Pa, tension positive.
struct Tractions {
  Eigen::Vector2d left;  ///< P_xX, P_yX
  Eigen::Vector2d top;   ///< P_xY, P_yY
};

Tractions tractions_under(const Eigen::Matrix2d& gradient) {
  const fem::Grid grid = homogeneous_grid(21, 13);
  const double dt = stable_step(grid);
  auto solver =
      fem::ExplicitSolver<double>::create(grid, {.density_kg_per_m3 = kDensity, .time_step_s = dt, .simd = {}}).value();
  const auto node_of = [&](int row, int column) { return row * (grid.columns + 1) + column; };
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column)
      solver.set_node(node_of(row, column), gradient * kElementSize * Eigen::Vector2d(column, row),
                      Eigen::Vector2d::Zero());
  const fem::StepReport report = solver.step().value();
  // Every node has the mass rho h^2; a side hands h of its length to each of its nodes.
  const double scale = kDensity * kElementSize / dt;
  return {.left = scale * solver.velocity_m_per_s(node_of(6, 0)),
          .top = {-scale * solver.velocity_m_per_s(node_of(grid.rows, 10)).x(), report.top_stress_pa}};
}

// Simple shear u_x = gamma y keeps J = 1, so that P_xY = P_yX = mu gamma and P_xX = P_yY = 0 at any gamma: to 1e-12 of
// E, up to gamma = 0.8.
TEST(ExplicitElement, SimpleShearGivesMuTimesGamma) {
  const double mu_pa = material::lame_from_engineering(kYoung, kPoisson).mu_pa;
  for (const double gamma : {1e-4, 0.05, 0.3, 0.8}) {
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
    gradient(0, 1) = gamma;
    const Tractions found = tractions_under(gradient);
    EXPECT_NEAR(found.left.x(), 0.0, 1e-12 * kYoung);
    EXPECT_NEAR(found.left.y(), mu_pa * gamma, 1e-12 * kYoung);
    EXPECT_NEAR(found.top.x(), mu_pa * gamma, 1e-12 * kYoung);
    EXPECT_NEAR(found.top.y(), 0.0, 1e-12 * kYoung);
  }
}

// Any finite gradient: the tractions are those of P = dW/dF (Eq. 2.1), to 1e-12 of E.
TEST(ExplicitElement, TractionsAreThoseOfTheLaw) {
  const Eigen::Matrix2d stress =
      material::first_piola(finite_gradient(), material::lame_from_engineering(kYoung, kPoisson));
  const Tractions found = tractions_under(finite_gradient());
  EXPECT_LT((found.left - stress.col(0)).norm(), 1e-12 * kYoung);
  EXPECT_LT((found.top - stress.col(1)).norm(), 1e-12 * kYoung);
}

TEST(ExplicitElement, RigidRotationCausesNoForce) {
  double largest_double = 0.0, largest_single = 0.0;
  visit_accelerations<double>(rotation_gradient(),
                              [&](int, int, double value) { largest_double = std::max(largest_double, value); });
  visit_accelerations<float>(rotation_gradient(),
                             [&](int, int, double value) { largest_single = std::max(largest_single, value); });
  EXPECT_LT(largest_double, 1e-13);
  EXPECT_LT(largest_single, 3e-5);
}

TEST(ExplicitElement, TranslationCausesNoForce) {
  const fem::Grid grid = homogeneous_grid(9, 7);
  auto solver = fem::ExplicitSolver<float>::create(
                    grid, {.density_kg_per_m3 = kDensity, .time_step_s = stable_step(grid), .simd = {}})
                    .value();
  const Eigen::Vector2d shift(0.37e-3, 0.0);
  for (int node = 0; node < 80; ++node) solver.set_node(node, shift, Eigen::Vector2d::Zero());
  ASSERT_TRUE(solver.step());
  for (int node = 0; node < 80; ++node) EXPECT_EQ(solver.velocity_m_per_s(node).norm(), 0.0) << node;
}

/// Alternating columns of a grid get opposite velocities: the shortest wave that the filter of Eq. 2.4 sees.
fem::ExplicitSolver<double> with_shortest_wave(const fem::Grid& grid, double alpha, double velocity_m_per_s) {
  const double dt = stable_step(grid);
  auto solver = fem::ExplicitSolver<double>::create(
                    grid, {.density_kg_per_m3 = kDensity, .time_step_s = dt, .gamma_per_s = alpha / dt, .simd = {}})
                    .value();
  for (int row = 1; row < grid.rows; ++row) {
    for (int column = 0; column <= grid.columns; ++column) {
      const double sign = column % 2 == 0 ? 1.0 : -1.0;
      solver.set_node(row * (grid.columns + 1) + column, Eigen::Vector2d::Zero(),
                      Eigen::Vector2d(0.0, sign * velocity_m_per_s));
    }
  }
  return solver;
}

/// What alternates from column to column in the displacements of the middle row, m.
double alternating_part_m(const fem::ExplicitSolver<double>& solver, const fem::Grid& grid) {
  double sum = 0.0;
  for (int column = 1; column < grid.columns; ++column) {
    const double displacement = solver.displacement_m(grid.rows / 2 * (grid.columns + 1) + column).y();
    sum += (column % 2 == 0 ? 1.0 : -1.0) * displacement / (grid.columns - 1);
  }
  return std::abs(sum);
}

TEST(ExplicitElement, SmoothingBoundsTheShortestWavesUpToItsLargestAlpha) {
  const fem::Grid grid = homogeneous_grid(21, 16);
  for (const double alpha : {0.1, 0.5, 0.7499}) {
    constexpr double kVelocity = 1e-3;
    auto solver = with_shortest_wave(grid, alpha, kVelocity);
    for (int step = 0; step < 2000; ++step) ASSERT_TRUE(solver.step()) << alpha;
    EXPECT_LT(alternating_part_m(solver, grid), kVelocity * stable_step(grid)) << alpha << ": one free step";
  }
}

TEST(ExplicitElement, SmoothingBeyondItsLargestAlphaIsRefusedWithTheStepThatWouldDo) {
  const fem::Grid grid = homogeneous_grid(8, 8);
  const auto refusal = [&](double alpha, fem::Damping damping) {
    const auto solver = fem::ExplicitSolver<float>::create(grid, {.density_kg_per_m3 = kDensity,
                                                                  .time_step_s = 1e-8,
                                                                  .damping = damping,
                                                                  .gamma_per_s = alpha / 1e-8,
                                                                  .simd = {}});
    return solver ? std::string() : solver.error().message;
  };
  EXPECT_EQ(refusal(0.7499, fem::Damping::smoothing), "");
  const std::string sentence = refusal(0.76, fem::Damping::smoothing);
  EXPECT_NE(sentence.find("alpha = gamma dt = 0.76 is beyond 0.75"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("time step at most 9.86"), std::string::npos) << sentence;
  EXPECT_EQ(refusal(0.76, fem::Damping::exponential), "") << "only the filter of Eq. 2.4 has this limit";
}

/// Pulls an unnotched homogeneous strip slowly (0.5 /s against a first resonance of some 1e4 /s), heavily damped.
template <class Visit>
void pull_strip(double threshold, double strain_limit, const Visit& visit) {
  const fem::Grid grid = homogeneous_grid(8, 12, threshold);
  const double dt = stable_step(grid);
  auto solver = fem::ExplicitSolver<float>::create(grid, {.density_kg_per_m3 = kDensity,
                                                          .time_step_s = dt,
                                                          .strain_rate_per_s = 5.0,
                                                          .gamma_per_s = 0.5 / dt,
                                                          .simd = {}})
                    .value();
  while (solver.strain() < strain_limit) {
    const Result<fem::StepReport> report = solver.step();
    ASSERT_TRUE(report) << report.error().message;
    if (!visit(*report)) return;
  }
}

// Quasi-static to within the lateral inertia at 5 /s: 0.2 % of the stress, from strain 1 % to 40 %.
TEST(ExplicitElement, HomogeneousStripFollowsTheClosedFormToFiniteStrain) {
  const material::Lame lame = material::lame_from_engineering(kYoung, kPoisson);
  double worst = 0.0;
  int compared = 0;
  pull_strip(std::numeric_limits<double>::infinity(), 0.4, [&](const fem::StepReport& report) {
    if (report.strain < 0.01) return true;
    const double expected = material::uniaxial_stress(report.strain, lame).nominal_stress_pa;
    worst = std::max(worst, std::abs(report.stress_pa() / expected - 1.0));
    ++compared;
    return true;
  });
  EXPECT_GT(compared, 1000);
  EXPECT_LT(worst, 2e-3);
}

/// Closed-form energy density of the homogeneous strip at a nominal strain, J/m^3.
double uniaxial_energy(double strain, const material::Lame& lame) {
  Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
  h(0, 0) = material::uniaxial_stress(strain, lame).lateral_stretch - 1.0;
  h(1, 1) = strain;
  return material::energy_density(h, lame);
}

// The threshold is that of strain 0.2; failure must come within 0.3 % of that strain (lateral inertia again).
TEST(ExplicitElement, HomogeneousStripBreaksWhereTheEnergyDensityReachesTheThreshold) {
  const material::Lame lame = material::lame_from_engineering(kYoung, kPoisson);
  for (const double failure_strain : {0.05, 0.2}) {
    double first_failure = 0.0;
    pull_strip(uniaxial_energy(failure_strain, lame), 0.3, [&](const fem::StepReport& report) {
      first_failure = report.strain;
      return report.failed == 0;
    });
    EXPECT_NEAR(first_failure, failure_strain, 3e-3 * failure_strain);
  }
}

}  // namespace
}  // namespace nacre
