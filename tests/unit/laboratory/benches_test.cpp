#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "laboratory/fracture_bench.hpp"
#include "laboratory/modulus_bench.hpp"
#include "material/neo_hookean.hpp"

namespace nacre::laboratory {
namespace {

constexpr double kSheetYoungPa = 0.5e9, kSheetPoisson = 0.35;

/// A strip of one material without notch.
Raster strip(int columns, int rows, double threshold_j_per_m3 = std::numeric_limits<double>::infinity()) {
  const material::Lame lame = material::lame_from_engineering(kSheetYoungPa, kSheetPoisson);
  const auto count = static_cast<std::size_t>(columns * rows);
  return {.columns = columns,
          .rows = rows,
          .mu_pa = std::vector<double>(count, lame.mu_pa),
          .lambda_pa = std::vector<double>(count, lame.lambda_pa),
          .threshold_j_per_m3 = std::vector<double>(count, threshold_j_per_m3),
          .all_soft = false};
}

Pull calm_pull(double strain_limit) { return {.gamma_per_s = 1e6, .strain_limit = strain_limit}; }

TEST(ModulusBench, AHomogeneousStripHasTheModulusOfItsMaterial) {
  EXPECT_NEAR(pull_elastically(strip(24, 16)).value() / kSheetYoungPa, 1.0, 1e-10);
}

TEST(ModulusBench, LayersAcrossTheLoadLieBetweenTheirSeriesBoundsAndColumnsAlongItGiveTheirMean) {
  Raster columns = strip(20, 20), layers = strip(20, 20);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      const auto e = static_cast<std::size_t>(row * 20 + column);
      if (column < 10) columns.mu_pa[e] *= 0.1, columns.lambda_pa[e] *= 0.1;
      if (row < 10) layers.mu_pa[e] *= 0.1, layers.lambda_pa[e] *= 0.1;
    }
  }
  // Equal Poisson ratios: columns stretch and contract alike, so that the mean is exact.
  EXPECT_NEAR(pull_elastically(columns).value() / (0.55 * kSheetYoungPa), 1.0, 1e-9);
  const double series = 1.0 / (0.5 / kSheetYoungPa + 0.5 / (0.1 * kSheetYoungPa));
  const double layered = pull_elastically(layers).value();
  EXPECT_GT(layered, series * (1.0 - 1e-9));
  EXPECT_LT(layered, 1.1 * series);
}

TEST(ModulusBench, ASpecimenCutInTwoIsRefused) {
  Raster cut = strip(8, 8);
  for (int column = 0; column < 8; ++column) cut.mu_pa[4 * 8 + column] = cut.lambda_pa[4 * 8 + column] = 0.0;
  EXPECT_FALSE(pull_elastically(cut).has_value());
}

TEST(FractureBench, AStripThatCannotBreakFollowsTheUniaxialClosedForm) {
  const Result<PulledSpecimen> pulled = pull_to_separation(strip(32, 24), calm_pull(0.08));
  ASSERT_TRUE(pulled.has_value()) << pulled.error().message;
  EXPECT_FALSE(pulled->separated);
  const material::Lame lame = material::lame_from_engineering(kSheetYoungPa, kSheetPoisson);
  for (std::size_t i = 1; i < pulled->curve.size(); ++i) {
    const double strain = pulled->curve.strain[i];
    if (strain < 0.005) continue;  // start-up ringing of the lateral contraction
    EXPECT_NEAR(pulled->curve.stress_pa[i] / material::uniaxial_stress(strain, lame).nominal_stress_pa, 1.0, 0.01)
        << strain;
  }
}

TEST(FractureBench, AStripBreaksWhereItsEnergyDensityReachesTheThreshold) {
  const double threshold = 1e6, strain = std::sqrt(2.0 * threshold / kSheetYoungPa);  // W = E e^2 / 2 at small strain
  const Result<PulledSpecimen> pulled = pull_to_separation(strip(32, 24, threshold), calm_pull(0.3));
  ASSERT_TRUE(pulled.has_value()) << pulled.error().message;
  EXPECT_TRUE(pulled->separated);
  double peak_strain = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < pulled->curve.size(); ++i) {
    if (pulled->curve.stress_pa[i] > peak) peak = pulled->curve.stress_pa[i], peak_strain = pulled->curve.strain[i];
  }
  EXPECT_NEAR(peak_strain / strain, 1.0, 0.05);
  EXPECT_NEAR(tester::area_under(pulled->curve) / threshold, 1.0, 0.1);
}

TEST(FractureBench, AStripBreaksAtTheSameStrainWhereItsNeighbourhoodsReachTheThreshold) {
  Raster raster = strip(32, 24, 1e6);
  raster.neighbourhood_m = 4.0 * kElementM;
  const Result<PulledSpecimen> pulled = pull_to_separation(raster, calm_pull(0.3));
  ASSERT_TRUE(pulled.has_value()) << pulled.error().message;
  EXPECT_TRUE(pulled->separated);
  EXPECT_NEAR(tester::area_under(pulled->curve) / 1e6, 1.0, 0.1);
}

TEST(FractureBench, AMirroredSpecimenGivesTheSameCurve) {
  Raster left = strip(48, 32, 5e5), right = left;
  for (int column = 0; column < 12; ++column) {
    const auto from_left = static_cast<std::size_t>(16 * 48 + column),
               from_right = static_cast<std::size_t>(16 * 48 + 47 - column);
    left.mu_pa[from_left] = left.lambda_pa[from_left] = 0.0;
    right.mu_pa[from_right] = right.lambda_pa[from_right] = 0.0;
  }
  const Result<PulledSpecimen> a = pull_to_separation(left, calm_pull(0.3)),
                               b = pull_to_separation(right, calm_pull(0.3));
  ASSERT_TRUE(a.has_value() && b.has_value());
  EXPECT_NEAR(tester::area_under(a->curve) / tester::area_under(b->curve), 1.0,
              0.02);  // sums in another order, then cracks
}

TEST(FractureBench, TheSamePullGivesTheSameBits) {
  const auto once = [] {
    Raster notched = strip(48, 32, 5e5);
    for (int column = 0; column < 12; ++column) notched.mu_pa[16 * 48 + column] = 0.0;
    return pull_to_separation(notched, calm_pull(0.3)).value().curve;
  };
  EXPECT_EQ(once(), once());
}

TEST(FractureBench, ASofterThresholdNeverTakesMoreWorkToBreak) {
  double last = 0.0;
  for (const double threshold : {1e5, 3e5, 9e5}) {
    Raster notched = strip(48, 32, threshold);
    for (int column = 0; column < 12; ++column) {
      const auto e = static_cast<std::size_t>(16 * 48 + column);
      notched.mu_pa[e] = notched.lambda_pa[e] = 0.0;
    }
    const double work = tester::area_under(pull_to_separation(notched, calm_pull(0.3)).value().curve);
    EXPECT_GT(work, last);
    last = work;
  }
}

}  // namespace
}  // namespace nacre::laboratory
