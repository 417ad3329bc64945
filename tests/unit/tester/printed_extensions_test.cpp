// The extensions that act on geometry and constants of elements.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "pattern/coupons.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/fracture_test.hpp"
#include "tester/modulus.hpp"
#include "tester/notch.hpp"
#include "tester/strength_scatter.hpp"

namespace nacre::tester {
namespace {

using fem::Grid;

pattern::Pattern some_pattern() {
  RandomStream random(11, "printed extensions");
  return pattern::random_pattern(random);
}

Simulation with(material::Extensions extensions, pattern::Design design = some_pattern()) {
  Simulation simulation{.design = std::move(design),
                        .parameters = material::thesis_parameters(),
                        .conditions = {},
                        .fidelity = Fidelity::tiny};
  simulation.parameters.extensions = std::move(extensions);
  return simulation;
}

Grid unit_of(const material::Extensions& extensions, const pattern::Design& design, int refinement = 1) {
  const Simulation simulation = with(extensions, design);
  return assemble(design, simulation.parameters, {}, AssemblyTarget::toughness, 1, 1, refinement);
}

double rigid_share(const Grid& grid) {
  const auto rigid = std::count(grid.phase.begin(), grid.phase.end(), fem::Phase::rigid);
  return static_cast<double>(rigid) / grid.element_count();
}

// Whole notched specimens, with every knob of the loading: nothing may differ by a bit.
TEST(EveryEffect, AtZeroPullsTheBaseSpecimenToTheBit) {
  const FractureTest base = fracture_test(with({}));
  for (const material::Effect& effect : material::effect_library()) {
    const FractureTest test =
        fracture_test(with({{std::string(effect.name), std::vector<double>(effect.parameters.size(), 0.0)}}));
    EXPECT_EQ(test.grid.phase, base.grid.phase) << effect.name;
    EXPECT_EQ(test.grid.young_pa, base.grid.young_pa) << effect.name;
    EXPECT_EQ(test.grid.poisson, base.grid.poisson) << effect.name;
    EXPECT_EQ(test.grid.threshold_j_per_m3, base.grid.threshold_j_per_m3) << effect.name;
    EXPECT_EQ(test.settings.time_step_s, base.settings.time_step_s) << effect.name;
    EXPECT_FALSE(test.grid.laws.any()) << effect.name << ": the base kernel does the work";
  }
}

TEST(Overprint, LeavesTheBaseModelContinuously) {
  const pattern::Design design = some_pattern();
  for (const double anisotropy : {0.0, 0.3}) {
    const Grid base = unit_of({{"interface_anisotropy", {anisotropy}}}, design);
    for (const double pixels : {1e-7, 1e-4, 1e-2}) {
      const Grid grid = unit_of({{"rigid_overprint", {pixels}}, {"interface_anisotropy", {anisotropy}}}, design);
      double largest = 0.0;
      for (std::size_t e = 0; e < grid.young_pa.size(); ++e)
        largest = std::max(largest, std::abs(std::log(grid.young_pa[e] / base.young_pa[e])));
      EXPECT_LT(largest, 15.0 * pixels + 1e-7) << pixels;
      EXPECT_GT(largest, pixels) << pixels;
    }
  }
}

// Half a pixel is one element: every side of a rigid block moves by one, and the interface with it.
TEST(Overprint, ByHalfAPixelMovesEveryBoundaryByOneElement) {
  const pattern::Layout blocks = pattern::checkerboard(5);
  const Grid base = unit_of({}, blocks), grid = unit_of({{"rigid_overprint", {0.5}}}, blocks);
  EXPECT_GT(rigid_share(grid), rigid_share(base) + 0.1);
  // Along the row through the middle of the blocks: 9 rigid elements, 1 interface, 9 soft, 1 interface.
  const auto phases_in_row = [](const Grid& g, int row) {
    std::string text;
    for (int column = 0; column < g.columns; ++column)
      text += "sri."[static_cast<std::size_t>(g.phase[g.index(row, column)])];
    return text;
  };
  const std::string before = phases_in_row(base, 4), after = phases_in_row(grid, 4);
  EXPECT_EQ(std::count(before.begin(), before.end(), 'r'), 18);
  EXPECT_EQ(std::count(before.begin(), before.end(), 's'), 18);
  EXPECT_EQ(std::count(after.begin(), after.end(), 'r'), 22);
  EXPECT_EQ(std::count(after.begin(), after.end(), 's'), 14);
  EXPECT_EQ(std::count(after.begin(), after.end(), 'i'), 4);
}

TEST(Overprint, ClosesThinSoftFeaturesAndHardlyTouchesThickOnes) {
  const auto growth = [](const pattern::Layout& layout) {
    const auto soft = [&](const material::Extensions& extensions) {
      const Grid grid = unit_of(extensions, layout);
      return static_cast<double>(std::count(grid.phase.begin(), grid.phase.end(), fem::Phase::soft));
    };
    return soft({{"rigid_overprint", {0.5}}}) / soft({});
  };
  EXPECT_EQ(growth(pattern::checkerboard(1)), 0.0);
  EXPECT_GT(growth(pattern::checkerboard(5)), 0.5);
}

TEST(Overprint, StiffensSteadily) {
  const pattern::Design design = some_pattern();
  double last = 0.0;
  for (const double pixels : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0}) {
    const double modulus = test_modulus(with({{"rigid_overprint", {pixels}}}, design)).value().modulus_pa;
    EXPECT_GT(modulus, last) << pixels;
    last = modulus;
  }
}

TEST(Overprint, ComposesWithMixingAndFinerMeshes) {
  const pattern::Design design = some_pattern();
  const material::Extensions both = {{"rigid_overprint", {0.2}}, {"droplet_mixing", {0.6}}};
  for (const material::Extensions& extensions : {material::Extensions{{"rigid_overprint", {0.2}}}, both}) {
    const auto log_modulus = [&](const material::Extensions& e, int refinement) {
      return std::log(test_modulus(with(e, design), {.refinement = refinement}).value().modulus_pa);
    };
    const double coarse = log_modulus(extensions, 1) - log_modulus({}, 1),
                 fine = log_modulus(extensions, 2) - log_modulus({}, 2);
    EXPECT_GT(coarse, 0.02);
    EXPECT_NEAR(coarse, fine, 0.3 * coarse);
  }
}

TEST(StrengthScatter, HasTheDeclaredVariationAndKeepsTheMean) {
  for (const double variation : {0.05, 0.2, 0.5}) {
    Grid grid = unit_of({}, pattern::Mixture{1.0});
    const double threshold = grid.threshold_j_per_m3.front();
    std::vector<double> factors;
    for (int specimen = 0; specimen < 10; ++specimen) {
      Grid one = grid;
      scatter_strength(one, 1, variation, std::to_string(specimen));
      for (const double value : one.threshold_j_per_m3) factors.push_back(value / threshold);
    }
    double mean = 0.0, square = 0.0;
    for (const double factor : factors) mean += factor / static_cast<double>(factors.size());
    for (const double factor : factors)
      square += (factor - mean) * (factor - mean) / static_cast<double>(factors.size());
    EXPECT_NEAR(mean, 1.0, 4.0 * variation / std::sqrt(16000.0));
    EXPECT_NEAR(std::sqrt(square), variation, 0.04 * variation);
  }
}

TEST(StrengthScatter, IsTheSameVoxelsWhateverItsSizeAndOthersInAnotherSpecimen) {
  const auto thresholds = [](double variation, int specimen) {
    Simulation simulation = with({{"strength_scatter", {variation}}});
    simulation.specimen = specimen;
    return fracture_test(simulation).grid.threshold_j_per_m3;
  };
  const std::vector<double> base = thresholds(0.0, 0), weak = thresholds(0.1, 0), strong = thresholds(0.3, 0);
  int further = 0, standing = 0;
  for (std::size_t e = 0; e < base.size(); ++e) {
    if (!std::isfinite(base[e])) continue;
    ++standing;
    further += (weak[e] < base[e]) == (strong[e] < base[e]) ? 1 : 0;
  }
  EXPECT_GT(further, 0.93 * standing) << "a Weibull factor near its mean may change sides";
  EXPECT_NE(weak, thresholds(0.1, 1));
  EXPECT_EQ(weak, thresholds(0.1, 0));
}

TEST(StrengthScatter, OfAFinerMeshIsThatOfTheVoxels) {
  Grid coarse = unit_of({}, pattern::Mixture{1.0}), fine = unit_of({}, pattern::Mixture{1.0}, 2);
  scatter_strength(coarse, 1, 0.3, "a");
  scatter_strength(fine, 2, 0.3, "a");
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.columns; ++column)
      EXPECT_DOUBLE_EQ(fine.threshold_j_per_m3[fine.index(row, column)],
                       2.0 * coarse.threshold_j_per_m3[coarse.index(row / 2, column / 2)]);
}

Grid notched(double radius, int refinement = 1) {
  Grid grid =
      assemble(pattern::Mixture{1.0}, material::thesis_parameters(), {}, AssemblyTarget::toughness, 5, 4, refinement);
  cut_notch(grid, refinement);
  round_notch_root(grid, refinement, radius);
  return grid;
}

/// Area of matter, elements of the unrefined mesh.
double matter(const Grid& grid, int refinement = 1) {
  double area = 0.0;
  for (std::size_t e = 0; e < grid.phase.size(); ++e)
    area +=
        grid.phase[e] == fem::Phase::empty ? 0.0 : grid.young_pa[e] / material::thesis_parameters().toughness.e_vw_pa;
  return area / (refinement * refinement);
}

TEST(BluntNotch, DrillsACircleWhoseFrontStaysWhereTheNotchEnds) {
  const Grid sharp = notched(0.0), round = notched(0.03);  // 6 elements
  for (int row = 0; row < sharp.rows; ++row)
    for (int column = 40; column < sharp.columns; ++column)
      EXPECT_EQ(round.phase[static_cast<std::size_t>(round.index(row, column))], fem::Phase::rigid);
  // The circle less what was cut before: the notch, and the triangle where it reaches into the circle.
  const double removed = matter(sharp) - matter(round);
  EXPECT_NEAR(removed, std::numbers::pi * 36.0 - 12.0, 4.0);
  EXPECT_NEAR(matter(notched(0.03, 2), 2), matter(round), 1.0) << "the same hole on a finer mesh";
}

TEST(BluntNotch, ElementsThatItCutsYieldByTheAreaLeftToo) {
  Grid grid = assemble(pattern::Mixture{1.0}, material::thesis_parameters(), {}, AssemblyTarget::toughness, 5, 4, 1);
  grid.laws.yield_pa.assign(grid.phase.size(), 2e7);
  round_notch_root(grid, 1, 0.03);
  for (std::size_t e = 0; e < grid.phase.size(); ++e) {
    if (grid.phase[e] == fem::Phase::empty) continue;
    EXPECT_NEAR(grid.laws.yield_pa[e] / 2e7, grid.young_pa[e] / material::thesis_parameters().toughness.e_vw_pa, 1e-9);
  }
}

TEST(BluntNotch, GrowsSteadilyOnceItIsLargerThanTheNotchIsHigh) {
  double last = matter(notched(0.0));
  EXPECT_EQ(matter(notched(0.002)), last);
  for (const double radius : {0.005, 0.006, 0.01, 0.011, 0.02, 0.05}) {
    const double now = matter(notched(radius));
    EXPECT_LT(now, last) << radius;
    last = now;
  }
}

TEST(PlaneStrain, StiffensSoftLayersBetweenRigidOnesTheMostAndFeelsTheThickness) {
  const auto gain = [](const pattern::Design& design, double thickness_mm) {
    Simulation free = with({}, design), held = with({{"plane_strain", {0.5}}}, design);
    held.conditions.thickness_mm = thickness_mm;
    return test_modulus(held).value().modulus_pa / test_modulus(free).value().modulus_pa;
  };
  const pattern::Design layers = pattern::laminate(pattern::LayerDirection::along_x, 2, 2),
                        rigid = pattern::Mixture{1.0};
  EXPECT_GT(gain(rigid, 3.2), 1.01);
  EXPECT_GT(gain(layers, 3.2), gain(rigid, 3.2));
  EXPECT_GT(gain(rigid, 6.4), gain(rigid, 3.2));
}

}  // namespace
}  // namespace nacre::tester
