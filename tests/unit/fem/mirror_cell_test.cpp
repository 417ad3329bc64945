#include "fem/mirror_cell.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/random.hpp"

namespace nacre::fem {
namespace {

using Constants = std::vector<material::Lame>;

material::Lame of(double young_pa, double poisson) { return material::lame_from_engineering(young_pa, poisson); }

/// Elements of one to three lengths, of stiffnesses four decades apart.
struct RandomCell {
  std::vector<double> sizes;
  Constants lame;
};

RandomCell random_cell(int side, std::uint64_t seed) {
  RandomStream random(seed, "test");
  RandomCell cell;
  for (int i = 0; i < side; ++i) cell.sizes.push_back(1.0 + random.index(3));
  for (int e = 0; e < side * side; ++e) cell.lame.push_back(of(random.index(2) ? 1e9 : 1e5, 0.4 * random.uniform()));
  return cell;
}

TEST(MirrorCell, OfOneMaterialHasItsModulusAndOneEnergyEverywhere) {
  const std::vector<double> sizes = {0.5, 1.0, 1.0, 0.5};
  const auto cell = pull_cell(sizes, Constants(16, of(2e9, 0.35)));
  ASSERT_TRUE(cell) << cell.error().message;
  EXPECT_NEAR(cell->modulus_pa, 2e9, 2.0);
  for (const double energy : cell->energy_j_per_m3) EXPECT_NEAR(energy, 0.5 * 2e9, 1.0);
}

/// Without contraction, layers along the pull share its strain, layers across it its stress.
TEST(MirrorCell, OfLayersHasTheMeansOfVoigtAndReuss) {
  const std::vector<double> sizes = {0.5, 1.0, 1.0};
  const double stiff = 1e9, soft = 1e7, share = 1.5 / 2.5;  // the first two are stiff
  Constants along, across;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      along.push_back(of(column < 2 ? stiff : soft, 0.0));
      across.push_back(of(row < 2 ? stiff : soft, 0.0));
    }
  const double voigt = share * stiff + (1.0 - share) * soft, reuss = 1.0 / (share / stiff + (1.0 - share) / soft);
  const auto parallel = pull_cell(sizes, along), series = pull_cell(sizes, across);
  EXPECT_NEAR(parallel->modulus_pa / voigt, 1.0, 1e-9);
  EXPECT_NEAR(series->modulus_pa / reuss, 1.0, 1e-9);
  EXPECT_NEAR(parallel->energy_j_per_m3.front() / (0.5 * stiff), 1.0, 1e-9);
  EXPECT_NEAR(series->energy_j_per_m3.front() / (0.5 * reuss * reuss / stiff), 1.0, 1e-6);
  EXPECT_NEAR(series->energy_j_per_m3.back() / (0.5 * reuss * reuss / soft), 1.0, 1e-9);
}

TEST(MirrorCell, EnergiesAddUpToTheWorkOfThePull) {
  const RandomCell random = random_cell(7, 1);
  const auto cell = pull_cell(random.sizes, random.lame);
  const double length = std::accumulate(random.sizes.begin(), random.sizes.end(), 0.0);
  double energy = 0.0;
  for (std::size_t e = 0; e < random.lame.size(); ++e)
    energy += cell->energy_j_per_m3[e] * random.sizes[e / 7] * random.sizes[e % 7];
  EXPECT_NEAR(energy / (0.5 * cell->modulus_pa * length * length), 1.0, 1e-12);
}

/// Two cells side by side, and two on top of each other, mirror images of each other, are the same medium.
TEST(MirrorCell, MirroredItIsTheSameMedium) {
  constexpr int kSide = 5;
  const RandomCell half = random_cell(kSide, 2);
  const auto folded = [](int i) { return i < kSide ? i : 2 * kSide - 1 - i; };
  RandomCell whole;
  for (int row = 0; row < 2 * kSide; ++row) {
    whole.sizes.push_back(half.sizes[folded(row)]);
    for (int column = 0; column < 2 * kSide; ++column)
      whole.lame.push_back(half.lame[folded(row) * kSide + folded(column)]);
  }
  const auto small = pull_cell(half.sizes, half.lame), large = pull_cell(whole.sizes, whole.lame);
  EXPECT_NEAR(large->modulus_pa / small->modulus_pa, 1.0, 1e-8);
  for (int row = 0; row < 2 * kSide; ++row)
    for (int column = 0; column < 2 * kSide; ++column)
      EXPECT_NEAR(large->energy_j_per_m3[row * 2 * kSide + column] /
                      small->energy_j_per_m3[folded(row) * kSide + folded(column)],
                  1.0, 1e-5);
}

TEST(MirrorCell, NodesThatNothingHoldsAreAnError) {
  Constants lame(16, of(1e9, 0.3));
  for (std::size_t e = 4; e < 12; ++e) lame[e] = {.mu_pa = 0.0, .lambda_pa = 0.0};
  EXPECT_FALSE(pull_cell(std::vector<double>(4, 1.0), lame));
}

}  // namespace
}  // namespace nacre::fem
