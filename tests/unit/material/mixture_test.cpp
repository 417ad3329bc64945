#include "material/mixture.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace nacre::material {
namespace {

const Phases kPhases = {.soft = {1e6, 0.45, 1e5}, .interface = {1e8, 0.35, 1e7}, .rigid = {1e9, 0.25, 1e6}};

TEST(Mixture, MeetsTheThreeMaterialsExactly) {
  for (const auto& [fraction, expected] :
       {std::pair{0.0, kPhases.soft}, {0.5, kPhases.interface}, {1.0, kPhases.rigid}}) {
    const Constants constants = mixture(kPhases, fraction);
    EXPECT_EQ(constants.young_pa, expected.young_pa);
    EXPECT_EQ(constants.poisson, expected.poisson);
    EXPECT_EQ(constants.threshold_j_per_m3, expected.threshold_j_per_m3);
  }
}

TEST(Mixture, RunsGeometricallyInStiffnessAndStrengthAndLinearlyInPoissonsRatio) {
  const Constants quarter = mixture(kPhases, 0.25), most = mixture(kPhases, 0.75);
  EXPECT_NEAR(quarter.young_pa, 1e7, 1.0);
  EXPECT_NEAR(quarter.threshold_j_per_m3, 1e6, 1e-3);
  EXPECT_NEAR(quarter.poisson, 0.40, 1e-15);
  EXPECT_NEAR(most.young_pa, std::sqrt(1e17), 1.0);
  EXPECT_NEAR(most.poisson, 0.30, 1e-15);
}

TEST(Mixture, IsContinuous) {
  for (const double fraction : {0.0, 0.5, 1.0}) {
    const double nearby = fraction == 0.0 ? 1e-9 : fraction - 1e-9;
    EXPECT_NEAR(mixture(kPhases, nearby).young_pa / mixture(kPhases, fraction).young_pa, 1.0, 1e-7);
  }
}

TEST(Mixture, NeverFailsInTheModulusTester) {
  const Phases phases = phases_of(thesis_parameters().modulus);
  for (const double fraction : {0.0, 0.3, 0.5, 0.8, 1.0})
    EXPECT_TRUE(std::isinf(mixture(phases, fraction).threshold_j_per_m3));
}

}  // namespace
}  // namespace nacre::material
