#include "game/family_errors.hpp"

#include <gtest/gtest.h>

namespace nacre::game {
namespace {

/// Two seeds and two chosen designs; the family's own model is nearer to the seeds and farther from the chosen ones.
std::vector<FamilyDesign> over_fitted() {
  const DesignValues measured{1e9, 4e5}, near{1.01e9, 4.1e5}, off{1.2e9, 5e5}, far{1.5e9, 8e5};
  std::vector<FamilyDesign> designs;
  for (const std::uint64_t bits : {1, 2, 3, 4}) {
    const bool is_seed = bits < 3;
    designs.push_back({pattern::Pattern(bits), is_seed, measured, off, is_seed ? near : far});
  }
  return designs;
}

TEST(FamilyErrors, AnErrorOfNothingIsNoErrorOfZero) {
  EXPECT_EQ(error_over(0, 0.0), std::nullopt);
  EXPECT_EQ(error_over(1, 0.0), 0.0);
  EXPECT_EQ(error_over(3, 0.2), 0.2);
}

TEST(FamilyErrors, AModelThatKnowsItsSeedsAloneOverFits) {
  const FamilyErrors errors = family_errors(over_fitted());
  EXPECT_TRUE(errors.judges_modulus() && errors.judges_toughness());
  EXPECT_TRUE(errors.over_fits_modulus() && errors.over_fits_toughness());
}

TEST(FamilyErrors, WhatWasNotMeasuredIsNotJudged) {
  std::vector<FamilyDesign> designs = over_fitted();
  for (FamilyDesign& design : designs)
    if (!design.is_seed) design.measured.modulus_pa.reset();
  const FamilyErrors errors = family_errors(designs);
  EXPECT_FALSE(errors.judges_modulus());
  EXPECT_FALSE(errors.over_fits_modulus());
  EXPECT_TRUE(errors.over_fits_toughness());
}

TEST(FamilyErrors, AModelThatCouldNotSimulateItsSeedsIsNotNearerToThem) {
  std::vector<FamilyDesign> designs = over_fitted();
  for (FamilyDesign& design : designs)
    if (design.is_seed) design.family_model = {};
  const FamilyErrors errors = family_errors(designs);
  EXPECT_FALSE(errors.judges_toughness());
  EXPECT_FALSE(errors.over_fits_modulus() || errors.over_fits_toughness());
}

TEST(FamilyErrors, AGlobalModelThatCouldNotSimulateTheChosenDesignsIsNotNearerToThem) {
  std::vector<FamilyDesign> designs = over_fitted();
  for (FamilyDesign& design : designs)
    if (!design.is_seed) design.global_model = {};
  const FamilyErrors errors = family_errors(designs);
  EXPECT_FALSE(errors.over_fits_modulus() || errors.over_fits_toughness());
}

}  // namespace
}  // namespace nacre::game
