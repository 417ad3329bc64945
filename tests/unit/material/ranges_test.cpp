#include "material/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::material {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::string_view kHeader = "tester,fitted_to,parameter,minimum,maximum\n";

std::string error_in(const std::string& rows) {
  try {
    (void)parse_ranges(std::string(kHeader) + rows, "inks.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const ParameterRange* range_named(std::span<const ParameterRange> ranges, std::string_view name) {
  for (const ParameterRange& range : ranges)
    if (range.name == name) return &range;
  return nullptr;
}

TEST(Ranges, AreThoseOfTheThesisTables) {
  const auto table = std::filesystem::path(NACRE_SOURCE_DIR) / "data" / "thesis" / "parameter_ranges.csv";
  EXPECT_EQ(read_ranges(table), thesis_ranges());
  EXPECT_EQ(std::ranges::count(read_file(table), '\n'), 1 + 34) << "a range that the file lacks would go unseen";
}

TEST(Ranges, StandInTheOrderOfTheVectors) {
  for (const FitTarget target : {FitTarget::base, FitTarget::microstructures}) {
    for (std::size_t i = 0; i < kModulusParameterCount; ++i)
      EXPECT_EQ(thesis_ranges().modulus(target)[i].name, modulus_parameter_names()[i]);
    for (std::size_t i = 0; i < kToughnessParameterCount; ++i)
      EXPECT_EQ(thesis_ranges().toughness(target)[i].name, toughness_parameter_names()[i]);
  }
}

TEST(Ranges, WideOnesAreSearchedInDecades) {
  const auto ranges = thesis_ranges().toughness(FitTarget::microstructures);
  EXPECT_TRUE(range_named(ranges, "e_tb_pa")->logarithmic());
  EXPECT_FALSE(range_named(ranges, "nu_tb")->logarithmic());
  EXPECT_NEAR(from_unit(*range_named(ranges, "e_tb_pa"), 0.5), std::sqrt(5e5 * 5e8), 1.0);
  EXPECT_NEAR(from_unit(*range_named(ranges, "nu_tb"), 0.5), 0.45, 1e-15);
  for (const ParameterRange& range : ranges)
    for (const double unit : {0.0, 0.3, 1.0}) EXPECT_NEAR(to_unit(range, from_unit(range, unit)), unit, 1e-12);
}

TEST(Ranges, ThoseOfOtherInksReplaceTheOnesTheyName) {
  const ParameterRanges ranges = parse_ranges(
      std::string(kHeader) + "modulus,microstructures,e_vw_pa,8e8,1.3e9\n\ntoughness,base,nu_if,0.25,0.5\n",
      "inks.csv");
  ParameterRanges expected = thesis_ranges();
  expected.microstructure_modulus[1] = {"e_vw_pa", 8e8, 1.3e9};
  expected.base_toughness[5] = {"nu_if", 0.25, 0.5};
  EXPECT_EQ(ranges, expected);
  EXPECT_NE(ranges, thesis_ranges());
}

TEST(Ranges, WhatLiesOutsideBeginsInTheMiddle) {
  EXPECT_EQ(brought_inside(default_parameters(), thesis_ranges()), default_parameters());
  ParameterRanges ranges = thesis_ranges();
  ranges.microstructure_modulus[1] = {"e_vw_pa", 8e8, 1.2e9};
  ranges.microstructure_toughness[0] = {"e_tb_pa", 1e5, 1e7};
  ParameterSet expected = default_parameters();
  expected.modulus.e_vw_pa = 1e9;
  expected.toughness.e_tb_pa = 1e6;  // its range is searched in decades
  const ParameterSet inside = brought_inside(default_parameters(), ranges);
  EXPECT_NEAR(inside.toughness.e_tb_pa, expected.toughness.e_tb_pa, 1.0);
  expected.toughness.e_tb_pa = inside.toughness.e_tb_pa;
  EXPECT_EQ(inside, expected);
}

TEST(Ranges, WrittenAreReadBackToTheBit) {
  ParameterRanges ranges = thesis_ranges();
  ranges.base_modulus[0].maximum = 1e7 / 3.0;
  ranges.microstructure_toughness[9].minimum = 1e4 / 7.0;
  EXPECT_EQ(parse_ranges(to_csv(ranges), "written"), ranges);
}

TEST(Ranges, ErrorsNameFileLineColumnAndWhatWasExpected) {
  EXPECT_THAT(error_in("stiffness,base,e_vw_pa,1e9,2e9\n"),
              AllOf(HasSubstr("inks.csv:2: column tester"), HasSubstr("expected modulus or toughness")));
  EXPECT_THAT(error_in("modulus,coupons,e_vw_pa,1e9,2e9\n"), HasSubstr("expected base or microstructures"));
  EXPECT_THAT(error_in("modulus,base,w_vw_j_per_m3,1e5,1e6\n"),
              AllOf(HasSubstr("column parameter"), HasSubstr("expected one of e_tb_pa, e_vw_pa")));
  EXPECT_THAT(error_in("modulus,base,e_vw_pa,1e9,2e9\nmodulus,base,e_vw_pa,1e9,3e9\n"),
              AllOf(HasSubstr("inks.csv:3"), HasSubstr("a second time")));
  EXPECT_THAT(error_in("modulus,base,e_vw_pa,2e9,2e9\n"), HasSubstr("expected more than the minimum"));
  EXPECT_THAT(error_in("modulus,base,e_vw_pa,0,2e9\n"), HasSubstr("expected a positive number"));
  EXPECT_THAT(error_in("modulus,base,nu_vw,0.2,0.6\n"), HasSubstr("expected at most 0.5"));
}

}  // namespace
}  // namespace nacre::material
