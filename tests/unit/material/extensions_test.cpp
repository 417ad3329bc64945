#include "material/extensions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "material/confinement.hpp"
#include "material/effect_library.hpp"
#include "material/effect_words.hpp"
#include "material/neo_hookean.hpp"

namespace nacre::material {
namespace {

TEST(Strength, GoesThroughItsValueAndBack) {
  for (const Effect& effect : effect_library())
    for (const EffectParameter& parameter : effect.parameters)
      for (const double strength : {0.05, 0.3, 1.0}) {
        const double value = value_at_strength(parameter, strength);
        EXPECT_TRUE(parameter.allows(value)) << effect.name << " " << value;
        EXPECT_NEAR(strength_of(parameter, value), strength, 1e-12) << effect.name;
      }
}

TEST(Strength, OfNothingIsTheBaseModel) {
  for (const Effect& effect : effect_library()) {
    const EffectParameter& parameter = effect.parameters.front();
    EXPECT_NE(parameter.strength, Strength::scale) << "the first parameter says how strong an effect is";
    EXPECT_EQ(value_at_strength(parameter, 0.0), 0.0) << effect.name;
    EXPECT_EQ(strength_of(parameter, 0.0), 0.0) << effect.name;
  }
}

TEST(EffectWords, AFormSaysWhatItIsAFormOf) {
  EXPECT_EQ(effect_in_words("droplet_mixing"), "droplet mixing");
  EXPECT_EQ(effect_in_words("rigid_yield with rate_by_phase"), "rigid yield with rate dependence by phase");
  EXPECT_EQ(effect_in_words("rate_prony, rate_power_law"), "two-branch rate dependence, power-law rate dependence");
}

TEST(Limits, AreAllowedFromTheSmallestOnAndAtZero) {
  const EffectParameter limit{"a limit", "Pa", 0.0, 1e9, Strength::reciprocal, 1e7};
  EXPECT_TRUE(limit.allows(0.0));
  EXPECT_TRUE(limit.allows(1e7));
  EXPECT_FALSE(limit.allows(9e6));
  EXPECT_FALSE(limit.allows(2e9));
  EXPECT_FALSE(limit.allows(-1e7));
  EXPECT_THAT(limit.range(), ::testing::HasSubstr("0 or 1"));
}

// E / (1 - nu^2) and the mu of the free sheet: plane strain in closed form.
TEST(Confinement, AtOneIsPlaneStrain) {
  const Constants sheet{.young_pa = 2e9, .poisson = 0.35, .threshold_j_per_m3 = 1e6};
  const Constants held = confined(sheet, 1.0);
  EXPECT_NEAR(held.young_pa, 2e9 / (1.0 - 0.35 * 0.35), 1e-3);
  EXPECT_NEAR(held.poisson, 0.35 / (1.0 - 0.35), 1e-12);
  EXPECT_EQ(held.threshold_j_per_m3, sheet.threshold_j_per_m3);
  const Lame free = lame_from_engineering(sheet.young_pa, sheet.poisson),
             lame = lame_from_engineering(held.young_pa, held.poisson);
  EXPECT_NEAR(lame.mu_pa, free.mu_pa, 1e-3);
  EXPECT_NEAR(lame.lambda_pa, 2.0 * free.mu_pa * 0.35 / (1.0 - 0.7), 1e-2);
}

TEST(Confinement, StiffensSteadilyAndStaysFiniteForIncompressibleMaterial) {
  const Constants rubber{.young_pa = 1e6, .poisson = 0.5, .threshold_j_per_m3 = 1e5};
  double last = 0.0;
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    const double young = confined(rubber, share).young_pa;
    EXPECT_GT(young, last);
    EXPECT_LT(young, 1.4e6);
    last = young;
  }
  EXPECT_EQ(confined(rubber, 0.0).young_pa, 1e6);
}

TEST(Confinement, GrowsWithThicknessFromTheStandardOne) {
  const Extensions extensions = {{"plane_strain", {0.4}}};
  EXPECT_NEAR(plane_strain_share(extensions, 3.2), 0.4, 1e-15);
  EXPECT_GT(plane_strain_share(extensions, 6.4), 0.5);
  EXPECT_LT(plane_strain_share(extensions, 1.6), 0.3);
  EXPECT_EQ(plane_strain_share({}, 6.4), 0.0);
  EXPECT_EQ(plane_strain_share({{"plane_strain", {1.0}}}, 1.6), 1.0);
}

}  // namespace
}  // namespace nacre::material
