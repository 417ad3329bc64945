#include "tester/unit_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/statistics.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/modulus.hpp"

namespace nacre::tester {
namespace {

std::vector<pattern::Pattern> random_patterns(int count) {
  RandomStream random(1, "test");
  std::vector<pattern::Pattern> patterns;
  for (int i = 0; i < count; ++i)
    patterns.push_back(i % 2 == 0 ? pattern::random_pattern(random) : pattern::random_barred_pattern(random));
  return patterns;
}

TEST(UnitCell, AllRigidItIsTheRigidMaterialLoadedEverywhereAlike) {
  const material::ParameterSet parameters = material::thesis_parameters();
  const auto cell = pull_unit_cell(pattern::Pattern(pattern::kAllFreePixels), parameters, AssemblyTarget::toughness);
  ASSERT_TRUE(cell) << cell.error().message;
  const material::ToughnessParameters& eta = parameters.toughness;
  EXPECT_NEAR(cell->modulus_pa / eta.e_vw_pa, 1.0, 1e-9);
  for (const double load : cell->load) EXPECT_NEAR(load / (0.5 * eta.e_vw_pa / eta.w_vw_j_per_m3), 1.0, 1e-9);
}

/// A specimen of two units with free sides is a little softer or stiffer than an endless one, and ranks alike: with the
/// model as it is and with one that blurs the boundaries.
TEST(UnitCell, PredictsTheModulusTester) {
  const auto patterns = random_patterns(60);
  for (const double mixing_pixels : {0.0, 0.8}) {
    material::ParameterSet parameters = material::thesis_parameters();
    if (mixing_pixels > 0.0) parameters.extensions["droplet_mixing"] = {mixing_pixels};
    std::vector<double> predicted, tested;
    for (const pattern::Pattern& pattern : patterns) {
      predicted.push_back(pull_unit_cell(pattern, parameters, AssemblyTarget::modulus)->modulus_pa);
      tested.push_back(test_modulus({pattern, parameters, {}, Fidelity::preview})->modulus_pa);
      EXPECT_LT(std::abs(std::log(predicted.back() / tested.back())), 0.15) << pattern.key();
    }
    EXPECT_GT(rank_correlation(predicted, tested), 0.99) << mixing_pixels;
  }
}

/// A soft row in the middle of the rigid unit: the block of the quarter that holds it takes the energy.
TEST(UnitCell, TheWeakestPlaceIsLoadedMost) {
  pattern::Pattern pattern(pattern::kAllFreePixels);
  for (int column = 0; column < pattern::kSide; ++column) pattern.set(9, column, false);
  const auto cell = pull_unit_cell(pattern, material::thesis_parameters(), AssemblyTarget::toughness);
  const auto most = std::max_element(cell->load.begin(), cell->load.end()) - cell->load.begin();
  EXPECT_EQ(most / kCellBlocks, kCellBlocks - 1);
}

}  // namespace
}  // namespace nacre::tester
