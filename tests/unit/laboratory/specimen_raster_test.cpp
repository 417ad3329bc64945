#include "laboratory/specimen_raster.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "laboratory/draw.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/failure_criterion.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::laboratory {
namespace {

Truth full_truth() {
  Truth truth = draw_truth(11, tester::Fidelity::full);
  truth.effects = {};
  return truth;
}

material::ParameterSet parameters_of(const Truth& truth) {
  material::ParameterSet parameters = material::thesis_parameters();
  parameters.modulus = truth.modulus;
  parameters.toughness = truth.toughness;
  parameters.criterion = truth.criterion;
  return parameters;
}

/// Both published patterns, twenty random ones and a layout without symmetry.
std::vector<pattern::Layout> sample_layouts() {
  RandomStream random(3, "specimen raster test");
  std::vector<pattern::Layout> layouts = {pattern::layout_from_key("577fffe9fffdef").value(),
                                          pattern::layout_from_key("3ffc9b4ad4d2d9").value()};
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(20, random)) layouts.push_back(pattern.layout());
  pattern::Layout unsymmetric;
  for (int i = 0; i < pattern::kPixels; ++i)
    unsymmetric.set(i / pattern::kSide, i % pattern::kSide, random.index(5) < 3);
  layouts.push_back(unsymmetric);
  return layouts;
}

fem::Phase phase_of(Site site) {
  return site == Site::soft ? fem::Phase::soft : site == Site::rigid ? fem::Phase::rigid : fem::Phase::interface;
}

TEST(SpecimenRaster, SitesAtTheCentresOfTesterElementsAreTheTestersAssignment) {
  for (const pattern::Layout& layout : sample_layouts()) {
    const fem::Grid grid =
        tester::assemble(layout, material::thesis_parameters(), {}, tester::AssemblyTarget::toughness, 2, 1);
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const Site site = site_at(layout, (column + 0.5) * kTesterElementM, (row + 0.5) * kTesterElementM);
        ASSERT_EQ(phase_of(site), grid.phase[grid.index(row, column)])
            << pattern::key_of(layout) << " row " << row << " column " << column;
      }
    }
  }
}

/// Elements of the laboratory against the tester refined to the same size, at the given effect of both.
void expect_same_constants(const Truth& truth, const material::ParameterSet& parameters, double orientation_deg) {
  const SpecimenSize size = specimen_size(tester::TestKind::modulus, tester::Fidelity::full);
  for (const pattern::Layout& layout : sample_layouts()) {
    const Raster raster = fracture_raster(truth, layout, {.orientation_deg = orientation_deg}, size);
    fem::Grid grid = tester::assemble(layout, parameters, {.orientation_deg = orientation_deg},
                                      tester::AssemblyTarget::toughness, 2, 1, 2);
    tester::set_criterion(grid, 2, parameters.criterion);
    ASSERT_EQ(raster.columns, grid.columns);
    ASSERT_EQ(raster.rows, grid.rows);
    for (std::size_t e = 0; e < raster.mu_pa.size(); ++e) {
      const material::Lame expected = material::lame_from_engineering(grid.young_pa[e], grid.poisson[e]);
      ASSERT_NEAR(raster.mu_pa[e] / expected.mu_pa, 1.0, 1e-9) << pattern::key_of(layout) << " element " << e;
      ASSERT_NEAR(raster.lambda_pa[e] / expected.lambda_pa, 1.0, 1e-9);
      ASSERT_NEAR(raster.threshold_j_per_m3[e] / grid.threshold_j_per_m3[e], 1.0, 1e-9);
    }
  }
}

TEST(SpecimenRaster, ConstantsAreThoseOfATesterRefinedToTheSameElements) {
  expect_same_constants(full_truth(), parameters_of(full_truth()), 0.0);
}

TEST(SpecimenRaster, DropletMixingAveragesOverTheSameSquareAsTheTestersExtension) {
  for (const double pixels : {0.1, 0.4, 1.0, 1.7}) {
    Truth truth = full_truth();
    truth.effects.droplet_mixing_pixels = pixels;
    material::ParameterSet parameters = parameters_of(truth);
    parameters.extensions["droplet_mixing"] = {pixels};
    expect_same_constants(truth, parameters, 0.0);
  }
}

TEST(SpecimenRaster, AnisotropyTurnsWithThePrintersAxesAsTheTestersExtensionDoes) {
  for (const double orientation_deg : {0.0, 90.0}) {
    Truth truth = full_truth();
    truth.effects.interface_anisotropy = -0.35;
    material::ParameterSet parameters = parameters_of(truth);
    parameters.extensions["interface_anisotropy"] = {-0.35};
    expect_same_constants(truth, parameters, orientation_deg);
  }
}

/// Expects the effect to weaken elements of the given sites alone, to 0.6 of what they were.
void expect_weakened(const HiddenEffects& effects, const std::vector<Site>& sites) {
  Truth weak = full_truth();
  weak.effects = effects;
  const pattern::Layout layout = sample_layouts().back();
  const SpecimenSize size = specimen_size(tester::TestKind::modulus, tester::Fidelity::full);
  const Raster before = fracture_raster(full_truth(), layout, {.orientation_deg = 0.0}, size);
  const Raster after = fracture_raster(weak, layout, {.orientation_deg = 0.0}, size);
  int weakened = 0;
  for (int row = 0; row < after.rows; ++row) {
    for (int column = 0; column < after.columns; ++column) {
      const auto e = static_cast<std::size_t>(row * after.columns + column);
      const Site site = site_at(layout, (column + 0.5) * kElementM, (row + 0.5) * kElementM);
      const bool weakens = std::ranges::find(sites, site) != sites.end();
      weakened += weakens;
      EXPECT_NEAR(after.mu_pa[e] / before.mu_pa[e], weakens ? 0.6 : 1.0, 1e-12);
      EXPECT_NEAR(after.threshold_j_per_m3[e] / before.threshold_j_per_m3[e], weakens ? 0.6 : 1.0, 1e-12);
    }
  }
  EXPECT_GT(weakened, 0);
}

TEST(SpecimenRaster, CornerDebondingWeakensOnlyAreasWhereFourPixelsMeet) {
  expect_weakened({.corner_debonding = 0.4}, {Site::corner, Site::diagonal});
}

TEST(SpecimenRaster, DiagonalDebondingWeakensOnlyContactsAcrossACorner) {
  expect_weakened({.diagonal_debonding = 0.4}, {Site::diagonal});
  pattern::Layout checkerboard, laminate;
  for (int i = 0; i < pattern::kPixels; ++i) {
    const int row = i / pattern::kSide, column = i % pattern::kSide;
    checkerboard.set(row, column, (row + column) % 2 == 0);
    laminate.set(row, column, row % 4 < 2);
  }
  const double corner_m = kTesterElementM * 1.5;  // between the first four pixels
  EXPECT_EQ(site_at(checkerboard, corner_m, corner_m), Site::diagonal);
  EXPECT_NE(site_at(laminate, corner_m, corner_m + kPixelM), Site::diagonal);
}

TEST(SpecimenRaster, NotchAndCutAreVoidWhereTheTestersAre) {
  for (const tester::Fidelity fidelity : {tester::Fidelity::tiny, tester::Fidelity::preview, tester::Fidelity::full}) {
    const SpecimenSize size = specimen_size(tester::TestKind::toughness, fidelity);
    const tester::FractureTest test = tester::fracture_test({.design = pattern::Mixture{1.0},
                                                             .parameters = material::thesis_parameters(),
                                                             .conditions = {},
                                                             .fidelity = fidelity});
    ASSERT_EQ(size.columns, test.grid.columns);
    ASSERT_EQ(size.rows, test.grid.rows);
    for (int row = 0; row < size.rows; ++row) {
      for (int column = 0; column < size.columns; ++column) {
        const bool cut = is_cut_away(size, (column + 0.5) * kTesterElementM, (row + 0.5) * kTesterElementM);
        const auto e = static_cast<std::size_t>(test.grid.index(row, column));
        ASSERT_EQ(cut, test.grid.phase[e] == fem::Phase::empty) << row << " " << column;
      }
    }
  }
}

TEST(SpecimenRaster, EffectsOfZeroAreExactlyNothing) {
  Truth zero = full_truth();
  zero.effects = {.machine_compliance_per_pa = 0.0,
                  .droplet_mixing_pixels = 0.0,
                  .interface_anisotropy = -0.0,
                  .corner_debonding = 0.0,
                  .diagonal_debonding = 0.0,
                  .load_cell_gain = 0.0,
                  .toe_slack = 0.0};
  const SpecimenSize size = specimen_size(tester::TestKind::modulus, tester::Fidelity::full);
  const pattern::Layout layout = sample_layouts().back();
  const Raster a = modulus_raster(full_truth(), layout, {.orientation_deg = 0.0}, size),
               b = modulus_raster(zero, layout, {.orientation_deg = 0.0}, size);
  EXPECT_EQ(a.mu_pa, b.mu_pa);
  EXPECT_EQ(a.lambda_pa, b.lambda_pa);
}

}  // namespace
}  // namespace nacre::laboratory
