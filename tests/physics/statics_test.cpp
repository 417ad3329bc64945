// Verification of the modulus tester: limits that are known in closed form, symmetries, and the order of convergence.

#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "fem/static_solver.hpp"
#include "material/neo_hookean.hpp"
#include "material/ranges.hpp"
#include "pattern/coupons.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/modulus.hpp"

namespace nacre {
namespace {

constexpr double kStrain = 1e-4;
const material::ParameterSet kDefaults = material::thesis_parameters();

double modulus_of(const pattern::Design& design, const material::ParameterSet& parameters = kDefaults,
                  int refinement = 1) {
  const tester::Simulation simulation = {
      .design = design, .parameters = parameters, .conditions = {}, .fidelity = tester::Fidelity::full};
  const Result<tester::ModulusResult> result = tester::test_modulus(simulation, {.refinement = refinement});
  EXPECT_TRUE(result) << result.error().message;
  return result ? result->modulus_pa : 0.0;
}

double modulus_of(const fem::Grid& grid) {
  const Result<fem::StaticSolution> solution = fem::pull(grid, kStrain);
  EXPECT_TRUE(solution) << solution.error().message;
  return solution ? solution->top_stress_pa / kStrain : 0.0;
}

std::vector<pattern::Pattern> some_patterns(int count) {
  RandomStream random(7, "statics_test");
  return pattern::stratified_patterns(count, random);
}

fem::Grid assembled(const pattern::Design& design, const material::ParameterSet& parameters = kDefaults) {
  return tester::assemble(design, parameters, {}, tester::AssemblyTarget::modulus, 2, 1);
}

/// One material's constants everywhere, so that a pattern is homogeneous in all but name.
material::ParameterSet uniform_parameters() {
  material::ParameterSet parameters = kDefaults;
  material::ModulusParameters& theta = parameters.modulus;
  theta.e_tb_pa = theta.e_if_pa = theta.e_vw_pa;
  theta.nu_tb = theta.nu_if = theta.nu_vw;
  return parameters;
}

/// Arithmetic (Voigt) and harmonic (Reuss) means of the elements' moduli.
struct ModulusBounds {
  double reuss_pa = 0.0, voigt_pa = 0.0;
};

ModulusBounds bounds_of(const fem::Grid& grid) {
  double sum = 0.0, inverse_sum = 0.0;
  for (const double young : grid.young_pa) {
    sum += young;
    inverse_sum += 1.0 / young;
  }
  return {.reuss_pa = grid.element_count() / inverse_sum, .voigt_pa = sum / grid.element_count()};
}

TEST(Statics, UniformConstantsGiveTheMaterialPointWhateverThePattern) {
  const material::ParameterSet parameters = uniform_parameters();
  const double point = modulus_of(pattern::Mixture{1.0}, parameters);
  for (const pattern::Pattern& pattern : some_patterns(3))
    EXPECT_NEAR(modulus_of(pattern, parameters) / point, 1.0, 1e-9);
}

// One Poisson's ratio: then the arithmetic and harmonic means bound the modulus of any arrangement.
TEST(Statics, ModuliLieBetweenReussAndVoigt) {
  material::ParameterSet parameters = kDefaults;
  parameters.modulus.nu_tb = parameters.modulus.nu_if = parameters.modulus.nu_vw = 0.3;
  for (const pattern::Pattern& pattern : some_patterns(8)) {
    const ModulusBounds bounds = bounds_of(assembled(pattern, parameters));
    const double modulus = modulus_of(pattern, parameters);
    EXPECT_GT(modulus, bounds.reuss_pa);
    EXPECT_LT(modulus, bounds.voigt_pa);
  }
}

TEST(Statics, LaminateAlongThePullIsTheArithmeticMean) {
  material::ParameterSet parameters = kDefaults;
  parameters.modulus.nu_tb = parameters.modulus.nu_if = parameters.modulus.nu_vw = 0.3;
  for (const auto& [rigid, soft] : {std::pair{2, 2}, {1, 1}, {3, 2}}) {
    const pattern::Layout layout = pattern::laminate(pattern::LayerDirection::along_y, rigid, soft);
    EXPECT_NEAR(modulus_of(layout, parameters) / bounds_of(assembled(layout, parameters)).voigt_pa, 1.0, 2e-4);
  }
}

// Without lateral coupling the layers are springs in series exactly, but for the secant at finite strain.
TEST(Statics, LaminateAcrossThePullIsTheHarmonicMean) {
  material::ParameterSet parameters = kDefaults;
  parameters.modulus.nu_tb = parameters.modulus.nu_if = parameters.modulus.nu_vw = 0.0;
  for (const auto& [rigid, soft] : {std::pair{2, 2}, {1, 1}, {3, 2}}) {
    const pattern::Layout layout = pattern::laminate(pattern::LayerDirection::along_x, rigid, soft);
    EXPECT_NEAR(modulus_of(layout, parameters) / bounds_of(assembled(layout, parameters)).reuss_pa, 1.0, 1e-3);
  }
}

TEST(Statics, ModuliScaleWithTheMaterials) {
  material::ParameterSet tripled = kDefaults;
  tripled.modulus.e_tb_pa *= 3.0;
  tripled.modulus.e_if_pa *= 3.0;
  tripled.modulus.e_vw_pa *= 3.0;
  for (const pattern::Pattern& pattern : some_patterns(2))
    EXPECT_NEAR(modulus_of(pattern, tripled) / modulus_of(pattern), 3.0, 1e-8);
}

TEST(Statics, AStifferPhaseNeverSoftensTheSpecimen) {
  for (const pattern::Pattern& pattern : some_patterns(2)) {
    const double base = modulus_of(pattern);
    for (double material::ModulusParameters::*young :
         {&material::ModulusParameters::e_tb_pa, &material::ModulusParameters::e_vw_pa,
          &material::ModulusParameters::e_if_pa}) {
      material::ParameterSet stiffer = kDefaults;
      stiffer.modulus.*young *= 1.1;
      EXPECT_GT(modulus_of(pattern, stiffer), base);
    }
  }
}

TEST(Statics, MirroringTheAssembledModelMirrorsTheSolution) {
  const fem::Grid grid = assembled(some_patterns(1).front());
  fem::Grid across = grid, upside_down = grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      const auto left_right = static_cast<std::size_t>(grid.index(row, grid.columns - 1 - column));
      const auto up_down = static_cast<std::size_t>(grid.index(grid.rows - 1 - row, column));
      across.young_pa[left_right] = grid.young_pa[e];
      across.poisson[left_right] = grid.poisson[e];
      upside_down.young_pa[up_down] = grid.young_pa[e];
      upside_down.poisson[up_down] = grid.poisson[e];
    }
  const double modulus = modulus_of(grid);
  EXPECT_NEAR(modulus_of(across) / modulus, 1.0, 1e-8);
  EXPECT_NEAR(modulus_of(upside_down) / modulus, 1.0, 1e-8);
}

/// A grid over [0, 1]^2 whose modulus varies smoothly over a decade.
fem::Grid smooth_grid(int side) {
  const auto count = static_cast<std::size_t>(side * side);
  fem::Grid grid{.columns = side,
                 .rows = side,
                 .element_size_m = 1.0 / side,
                 .phase = std::vector<fem::Phase>(count, fem::Phase::rigid),
                 .young_pa = std::vector<double>(count),
                 .poisson = std::vector<double>(count, 0.35),
                 .threshold_j_per_m3 = std::vector<double>(count, 1e300)};
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      grid.young_pa[grid.index(row, column)] =
          std::pow(10.0, 9.0 + 0.5 * std::cos(M_PI * (column + 0.5) / side) * std::sin(3.0 * (row + 0.5) / side));
  return grid;
}

/// log2 of the ratio of successive differences, for values at h, h/2, h/4.
double observed_order(double coarse, double middle, double fine) {
  return std::log2((coarse - middle) / (middle - fine));
}

TEST(Convergence, IsOfSecondOrderWhereTheMaterialIsSmooth) {
  const double order =
      observed_order(modulus_of(smooth_grid(20)), modulus_of(smooth_grid(40)), modulus_of(smooth_grid(80)));
  EXPECT_GT(order, 1.8);
  EXPECT_LT(order, 2.2);
}

// Corners where soft meets rigid carry singular stresses: energy converges with twice their exponent, which lies
// between 1/2 and 1.
TEST(Convergence, OfPatternsIsThatOfTheirCornersAndFromAbove) {
  for (const char* key : {"577fffe9fffdef", "3ffc9b4ad4d2d9"}) {
    const pattern::Design design = pattern::design_from_name(key).value();
    const double coarse = modulus_of(design), middle = modulus_of(design, kDefaults, 2),
                 fine = modulus_of(design, kDefaults, 4);
    EXPECT_GT(coarse, middle);
    EXPECT_GT(middle, fine);
    EXPECT_GT(observed_order(coarse, middle, fine), 1.0);
    EXPECT_LT(observed_order(coarse, middle, fine), 2.0);
    EXPECT_LT(std::abs(coarse / middle - 1.0), 0.12);
  }
}

TEST(Statics, TheDesignFoundStiffByTheThesisIsStifferThanTheToughOne) {
  const double stiff = modulus_of(pattern::design_from_name("577fffe9fffdef").value());
  const double tough = modulus_of(pattern::design_from_name("3ffc9b4ad4d2d9").value());
  EXPECT_GT(stiff, 1.5 * tough);
}

TEST(Statics, HoldsOverTheWholeRangeOfTheParameters) {
  RandomStream random(11, "statics_test");
  const auto ranges = material::thesis_ranges().modulus(material::FitTarget::microstructures);
  for (const pattern::Pattern& pattern : some_patterns(6)) {
    material::ModulusVector theta;
    // Three times as wide as Table A.2, as a diagnosis searches.
    for (std::size_t i = 0; i < theta.size(); ++i) {
      theta[i] = ranges[i].name.starts_with("nu_") ? random.uniform(0.0, 0.5)
                                                   : material::from_unit(ranges[i], random.uniform(-0.9, 2.0));
    }
    material::ParameterSet parameters = kDefaults;
    parameters.modulus = material::modulus_from_vector(theta);
    EXPECT_GT(modulus_of(pattern, parameters), 0.0);
  }
}

TEST(Statics, AnyNumberOfThreadsGivesTheSameBits) {
  const std::vector<pattern::Pattern> patterns = some_patterns(4);
  std::vector<double> alone, together(patterns.size());
  for (const pattern::Pattern& pattern : patterns) alone.push_back(modulus_of(pattern));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < patterns.size(); ++i)
    threads.emplace_back([&patterns, &together, i] { together[i] = modulus_of(patterns[i]); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(alone, together);
}

TEST(Statics, DirectionalInterfacesSeparateRotatedTwins) {
  const pattern::Pattern pattern = some_patterns(1).front();
  const auto modulus = [&pattern](double anisotropy, double orientation_deg) {
    tester::Simulation simulation = {.design = pattern,
                                     .parameters = kDefaults,
                                     .conditions = {.orientation_deg = orientation_deg},
                                     .fidelity = tester::Fidelity::full};
    simulation.parameters.extensions["interface_anisotropy"] = {anisotropy};
    return tester::test_modulus(simulation).value().modulus_pa;
  };
  EXPECT_EQ(modulus(0.0, 0.0), modulus(0.0, 90.0));
  EXPECT_GT(std::abs(modulus(0.3, 0.0) / modulus(0.3, 90.0) - 1.0), 1e-3);
  EXPECT_EQ(modulus(0.3, 90.0), modulus(-0.3, 0.0));
}

}  // namespace
}  // namespace nacre
