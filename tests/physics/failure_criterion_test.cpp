// The failure criteria with a length (tester/failure_criterion.hpp) against closed forms and on refined elements; the
// thesis' criterion has its laws in explicit_element_test.cpp.

#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "../grids.hpp"
#include "material/criterion_strengths.hpp"
#include "material/neo_hookean.hpp"
#include "specimens.hpp"
#include "tester/failure_criterion.hpp"

namespace nacre {
namespace {

using material::CriterionKind;
using verification::patterns;
using verification::specimen;

constexpr double kYoungPa = 1e9, kPoisson = 0.3, kDensity = 1150.0, kElementSize = 260e-6, kPi = std::numbers::pi;

double stable_step_s(const fem::Grid& grid) {
  return 0.8 * grid.element_size_m / fem::fastest_wave_m_per_s(grid, 1150);
}

/// Mode I of a sharp crack along the negative x axis in plane stress, for an energy release rate G.
struct SharpCrack {
  double release_j_per_m2;

  double intensity() const { return std::sqrt(kYoungPa * release_j_per_m2); }

  Eigen::Vector2d displacement_m(double x, double y) const {
    const double r = std::hypot(x, y), half = 0.5 * std::atan2(y, x), kappa = (3.0 - kPoisson) / (1.0 + kPoisson);
    const double mu = 0.5 * kYoungPa / (1.0 + kPoisson), c = std::cos(half), s = std::sin(half);
    const double scale = 0.5 * intensity() / mu * std::sqrt(0.5 * r / kPi);
    return scale * Eigen::Vector2d(c * (kappa - 1.0 + 2.0 * s * s), s * (kappa + 1.0 - 2.0 * c * c));
  }

  /// Strain energy density times the distance r to the tip.
  double density_times_r(double angle) const {
    const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle), s3 = std::sin(1.5 * angle);
    const double xx = c * (1.0 - s * s3), yy = c * (1.0 + s * s3), xy = c * s * std::cos(1.5 * angle);
    const double squares = xx * xx + yy * yy - 2.0 * kPoisson * xx * yy + 2.0 * (1.0 + kPoisson) * xy * xy;
    return release_j_per_m2 * squares / (4.0 * kPi);
  }
};

/// The mean of the energy density, with the tent of half-width R around a point `centre` ahead of the tip, for R = 1.
double tent_mean(const SharpCrack& crack, double centre) {
  constexpr int kAngles = 240, kRadii = 240;
  const double reach = centre + 1.5;
  double sum = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = kPi * (i + 0.5) / kAngles;
    double weights = 0.0;
    for (int k = 0; k < kRadii; ++k) {
      const double r = reach * (k + 0.5) / kRadii;
      weights += std::max(0.0, 1.0 - std::abs(r * std::cos(angle) - centre)) * std::max(0.0, 1.0 - r * std::sin(angle));
    }
    sum += 2.0 * crack.density_times_r(angle) * weights;  // above and below
  }
  return sum * kPi / kAngles * reach / kRadii;
}

/// G over R W at which a sharp crack grows by the neighbourhood criterion: 1 / c.
double integrated_fracture_energy() {
  double largest = 0.0;
  for (double centre = 0.0; centre < 0.8; centre += 0.02) largest = std::max(largest, tent_mean({1.0}, centre));
  return 1.0 / largest;
}

/// A square around the tip of a crack one element high, in equilibrium between sides that move as the sharp crack's.
class CrackedSquare {
 public:
  CrackedSquare(int half, const SharpCrack& crack) : half_(half), crack_(crack), grid_(grid(1e300)) {
    auto solver = solver_of(grid_);
    for (int node = 0; node < nodes(); ++node) solver.set_node(node, exact(node), Eigen::Vector2d::Zero());
    for (int step = 0; step < 12 * half; ++step) {
      for (int node = 0; node < nodes(); ++node)
        if (is_side(node)) solver.set_node(node, exact(node), Eigen::Vector2d::Zero());
      EXPECT_TRUE(solver.step());
    }
    for (int node = 0; node < nodes(); ++node) rest_.push_back(solver.displacement_m(node));
  }

  /// The first element that fails at once in this state, by its distance ahead of the tip in elements; or none.
  std::optional<int> first_failure(double threshold, double radius_m) const {
    fem::Grid now = grid(threshold);
    now.neighbourhood_m = radius_m;
    auto solver = solver_of(now);
    for (int node = 0; node < nodes(); ++node) solver.set_node(node, rest_[node], Eigen::Vector2d::Zero());
    EXPECT_TRUE(solver.step());
    const std::vector<int> failed = solver.last_failed();
    if (failed.empty()) return std::nullopt;
    return failed.front() % side() - half_;
  }

 private:
  int side() const { return 2 * half_ + 1; }
  int nodes() const { return (side() + 1) * (side() + 1); }
  bool is_side(int node) const {
    const int row = node / (side() + 1), column = node % (side() + 1);
    return row == 0 || row == side() || column == 0 || column == side();
  }
  Eigen::Vector2d exact(int node) const {
    const int row = node / (side() + 1), column = node % (side() + 1);
    return crack_.displacement_m(kElementSize * (column - half_), kElementSize * (row - half_ - 0.5));
  }
  fem::Grid grid(double threshold) const {
    fem::Grid made = fem::uniform_grid(side(), side(), {kYoungPa, kPoisson, threshold});
    for (int column = 0; column < half_; ++column)
      made.phase[static_cast<std::size_t>(made.index(half_, column))] = fem::Phase::empty;
    return made;
  }
  static fem::ExplicitSolver<double> solver_of(const fem::Grid& grid) {
    const double dt = stable_step_s(grid);
    return fem::ExplicitSolver<double>::create(
               grid, {.density_kg_per_m3 = kDensity, .time_step_s = dt, .gamma_per_s = 0.2 / dt, .simd = {}})
        .value();
  }

  int half_;
  SharpCrack crack_;
  fem::Grid grid_;
  std::vector<Eigen::Vector2d> rest_;
};

/// G over R W at which the element ahead of the tip fails, R being so many elements.
double found_fracture_energy(int elements) {
  const double radius_m = elements * kElementSize;
  const SharpCrack crack{1.0};
  const CrackedSquare square(std::max(12 * elements, 48), crack);
  double low = 0.1, high = 1.0;  // W in units of G / R
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (low + high);
    const std::optional<int> ahead = square.first_failure(middle * crack.release_j_per_m2 / radius_m, radius_m);
    EXPECT_LE(std::abs(ahead.value_or(0)), elements);
    (ahead ? low : high) = middle;
  }
  return 2.0 / (low + high);
}

/// G over h W at which the element ahead of the tip fails by its own energy, in a square of 2 half + 1 elements.
double element_fracture_energy(int half) {
  const SharpCrack crack{1.0};
  const CrackedSquare square(half, crack);
  double low = 0.1, high = 2.0;  // W in units of G / h
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (low + high);
    (square.first_failure(middle * crack.release_j_per_m2 / kElementSize, 0.0) ? low : high) = middle;
  }
  return 2.0 / (low + high);
}

// What ranges and built-in values of W follow.
TEST(FractureEnergy, OfElementsAndNeighbourhoodsIsThatOfTheStrengths) {
  const double elements = element_fracture_energy(48), neighbourhood = found_fracture_energy(2);
  std::printf("G_c: %.3f h W by elements, %.3f R W by neighbourhoods of R = 2 h\n", elements, neighbourhood);
  EXPECT_NEAR(elements / material::kElementFractureEnergy, 1.0, 0.01);
  EXPECT_NEAR(neighbourhood / material::kNeighbourhoodFractureEnergy, 1.0, 0.01);
}

TEST(NeighbourhoodCriterion, SharpCrackGrowsAtTheIntegratedFractureEnergy) {
  const double expected = integrated_fracture_energy();
  EXPECT_NEAR(expected, 8.0 * kPi / (1.54 * (5.0 - 3.0 * kPoisson)), 0.01 * expected);
  double last = 1.0;
  for (const auto& [elements, tolerance] : {std::pair{2, 0.15}, std::pair{4, 0.15}, std::pair{8, 0.03}}) {
    const double error = found_fracture_energy(elements) / expected - 1.0;
    std::printf("R = %d h: G_c off by %+.1f %%\n", elements, 100.0 * error);
    EXPECT_LT(std::abs(error), tolerance) << elements;
    EXPECT_LT(std::abs(error), last) << elements;
    last = std::abs(error);
  }
}

/// A strip without notch, with the length of one criterion; refined elements make the same strip.
fem::Grid strip(CriterionKind kind, double threshold, int refinement = 1) {
  fem::Grid grid = fem::uniform_grid(12 * refinement, 8 * refinement, {kYoungPa, kPoisson, threshold * refinement});
  grid.element_size_m /= refinement;
  tester::set_criterion(grid, refinement, {.kind = kind});
  return grid;
}

/// Pulls a strip slowly until an element fails; the strain at the largest stress.
double strain_at_peak(const fem::Grid& grid) {
  const double dt = stable_step_s(grid);
  auto solver = fem::ExplicitSolver<double>::create(grid, {.density_kg_per_m3 = kDensity,
                                                           .time_step_s = dt,
                                                           .strain_rate_per_s = 10.0,
                                                           .gamma_per_s = 0.3 / dt,
                                                           .simd = {}})
                    .value();
  double peak_pa = 0.0, strain = 0.0;
  while (true) {
    const fem::StepReport report = solver.step().value();
    if (report.stress_pa() > peak_pa) peak_pa = report.stress_pa(), strain = report.strain;
    if (report.failed > 0 || report.stress_pa() < 0.5 * peak_pa) return strain;
  }
}

TEST(FailureCriterion, HomogeneousStripBreaksAtTheThresholdOnEveryMesh) {
  constexpr double kStrain = 0.05;
  const material::Lame lame = material::lame_from_engineering(kYoungPa, kPoisson);
  Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
  h(0, 0) = material::uniaxial_stress(kStrain, lame).lateral_stretch - 1.0;
  h(1, 1) = kStrain;
  const double threshold = material::energy_density(h, lame);
  for (const CriterionKind kind : {CriterionKind::neighbourhood, CriterionKind::crack_band})
    for (const int refinement : {1, 2})
      EXPECT_NEAR(strain_at_peak(strip(kind, threshold, refinement)), kStrain, 5e-3 * kStrain)
          << material::to_string(kind) << " " << refinement;
}

/// Strain of the first failure at the notch of a specimen of rigid material, on elements of h / refinement.
double first_failure(CriterionKind kind, int refinement) {
  tester::Simulation simulation = specimen(pattern::Mixture{1.0});
  simulation.parameters.criterion.kind = kind;
  simulation.parameters.toughness.gamma_per_s *= refinement * refinement;
  const auto test = tester::fracture_test(simulation, {.refinement = refinement});
  auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
  while (true) {
    const fem::StepReport report = solver.step().value();
    if (report.failed > 0) return report.strain;
  }
}

TEST(NeighbourhoodCriterion, NotchOfFixedWidthConvergesInTheStrainOfFirstFailure) {
  const auto of = [](int refinement) { return first_failure(CriterionKind::neighbourhood, refinement); };
  const double h = of(1), half = of(2), quarter = of(4);
  std::printf("first failure %+.1f %% to h/2, %+.1f %% to h/4\n", 100.0 * (half / h - 1.0),
              100.0 * (quarter / half - 1.0));
  EXPECT_LT(std::abs(half / h - 1.0), 0.1);
  EXPECT_LT(std::abs(quarter / half - 1.0), 0.01);
  EXPECT_GT(first_failure(CriterionKind::element, 2) / first_failure(CriterionKind::element, 1), 1.15)
      << "a threshold that grows as 1/h";
}

/// Strain at which a ligament of one element between voids fails, R being so many elements.
double ligament_strain(int elements) {
  fem::Grid grid = fem::uniform_grid(3, 6 * elements, {kYoungPa, kPoisson, 1e5});
  for (int row = 0; row < grid.rows; ++row)
    for (const int column : {0, 2}) grid.phase[static_cast<std::size_t>(grid.index(row, column))] = fem::Phase::empty;
  grid.neighbourhood_m = elements * grid.element_size_m;
  return strain_at_peak(grid);
}

// Its neighbourhood has y in one column alone, whose weight is h / R: it fails at y = R / h. So it takes W R for every
// metre of its length, whatever the mesh: no bound on its own y is needed.
TEST(NeighbourhoodCriterion, LigamentOfOneElementTakesTheSameEnergyOnEveryMesh) {
  for (const int elements : {2, 4, 8}) {
    const double strain = ligament_strain(elements);
    const double ratio = 0.5 * kYoungPa * strain * strain / 1e5;
    EXPECT_NEAR(ratio / elements, 1.0, 0.05) << elements;
  }
}

tester::Simulation of_kind(const pattern::Design& design, CriterionKind kind) {
  tester::Simulation simulation = specimen(design);
  simulation.parameters.criterion.kind = kind;
  simulation.parameters.strength_cv = 0.1;
  return simulation;
}

// Through the start of a crack, and for a neighbourhood also where its elements soften (the extended kernel).
TEST(FailureCriterion, SameBitsFromEveryInstructionSet) {
  for (const auto& [kind, tail] :
       {std::pair{CriterionKind::neighbourhood, 0.0}, std::pair{CriterionKind::neighbourhood, 1.0},
        std::pair{CriterionKind::crack_band, 0.0}}) {
    tester::Simulation simulation = of_kind(patterns(2)[1], kind);
    if (tail > 0.0) simulation.parameters.extensions["progressive_damage"] = {tail};
    tester::FractureTest test = tester::fracture_test(simulation);
    test.settings.strain_rate_per_s *= 8.0;
    const auto results = verification::pulled_by_every_simd_level(test, 5000, 10);
    for (const auto& pulled : results) {
      EXPECT_GE(pulled.failed, 10);
      EXPECT_EQ(pulled.stresses_pa, results.front().stresses_pa)
          << fem::to_string(pulled.level) << " " << material::to_string(kind);
    }
  }
}

TEST(FailureCriterion, SameBitsOnAnyNumberOfThreads) {
  const std::vector<pattern::Design> designs = patterns(3);
  const auto results = [&](int threads) {
    std::vector<double> found(2 * designs.size());
    parallel_for(
        static_cast<int>(found.size()),
        [&](int i) {
          const CriterionKind kind = i % 2 == 0 ? CriterionKind::neighbourhood : CriterionKind::crack_band;
          found[i] = tester::test_toughness(of_kind(designs[i / 2], kind)).value().toughness_pa;
        },
        threads);
    return found;
  };
  EXPECT_EQ(results(3), results(1));
}

// The kernel of the crack band has the arithmetic of the base law, the extended kernel another one.
TEST(CrackBand, ItsKernelFollowsTheExtendedKernel) {
  tester::FractureTest test = tester::fracture_test(of_kind(patterns(2)[1], CriterionKind::crack_band));
  const tester::ToughnessResult band = tester::run_fracture_test<double>(test).value();
  test.grid.laws.is_crack_band = false;
  const tester::ToughnessResult extended = tester::run_fracture_test<double>(test).value();
  EXPECT_NEAR(extended.peak_stress_pa / band.peak_stress_pa, 1.0, 1e-6);
  EXPECT_NEAR(extended.toughness_pa / band.toughness_pa, 1.0, 1e-3);
  EXPECT_EQ(extended.breaks.front(), band.breaks.front());
}

// One row softens between rows too stiff to store energy: what it takes to break, over its height, is W (1 + v0) h0.
TEST(CrackBand, TakesTheSameEnergyOnEveryMesh) {
  constexpr double kThreshold = 2e5, kSoftening = 1.0;
  for (const int refinement : {1, 2}) {
    fem::Grid grid = fem::uniform_grid(12 * refinement, 8 * refinement, {100.0 * kYoungPa, 0.0, 1e9});
    grid.element_size_m /= refinement;
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(4 * refinement, column));
      grid.young_pa[e] = kYoungPa;
      grid.threshold_j_per_m3[e] = kThreshold * refinement;
    }
    tester::set_criterion(grid, refinement, {.kind = CriterionKind::crack_band, .softening = kSoftening});
    const double dt = 0.5 * grid.element_size_m / fem::fastest_wave_m_per_s(grid, kDensity);
    const fem::ExplicitSettings settings = {.density_kg_per_m3 = kDensity,
                                            .time_step_s = dt,
                                            .strain_rate_per_s = 20.0,
                                            .gamma_per_s = 0.3 / dt,
                                            .simd = {}};
    auto solver = fem::ExplicitSolver<float>::create(grid, settings).value();
    double work = 0.0;
    int failed = 0;
    while (failed < grid.columns && solver.strain() < 0.1) {
      const fem::StepReport report = solver.step().value();
      work += report.stress_pa() * settings.strain_rate_per_s * dt;
      failed += report.failed;
    }
    EXPECT_EQ(failed, grid.columns);
    EXPECT_NEAR(work * 8.0 / (kThreshold * (1.0 + kSoftening)), 1.0, 0.05) << refinement;
  }
}

}  // namespace
}  // namespace nacre
