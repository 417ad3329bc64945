#include "material/parameters.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "material/parameter_file.hpp"
#include "material/ranges.hpp"

namespace nacre::material {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kData = std::filesystem::path(NACRE_SOURCE_DIR) / "data";

std::filesystem::path written(const std::string& text) {
  const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::temp_directory_path() / fmt::format("nacre_{}_{}.toml", test, ::getpid());
  write_file_atomically(path, text);
  return path;
}

std::string error_of(const std::string& text) {
  try {
    (void)read_parameters(written(text), default_parameters());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Defaults, FileAndProgramAgree) {
  const ParameterSet nothing;
  EXPECT_EQ(read_parameters(kData / "defaults.toml", nothing), default_parameters());
  EXPECT_EQ(parameter_fault(default_parameters()), "");
}

TEST(Defaults, LieInTheMiddleOfTheToughnessRanges) {
  const ToughnessVector eta = to_vector(default_parameters().toughness);
  const auto ranges = default_ranges().toughness(FitTarget::microstructures);
  for (std::size_t i = 0; i < eta.size(); ++i) EXPECT_NEAR(to_unit(ranges[i], eta[i]), 0.5, 1e-3) << ranges[i].name;
}

TEST(Vectors, ComeBackAsTheyWent) {
  const ParameterSet set = default_parameters();
  EXPECT_EQ(modulus_from_vector(to_vector(set.modulus)), set.modulus);
  EXPECT_EQ(toughness_from_vector(to_vector(set.toughness)), set.toughness);
}

TEST(ParameterFile, WrittenIsReadBackToTheBit) {
  ParameterSet set = default_parameters();
  set.modulus.e_if_pa = 1.0 / 3.0 * 1e9;
  set.toughness.w_tb_j_per_m3 = 123456.789012345678;
  set.extensions["interface_anisotropy"] = {-0.1};
  set.extensions["machine_compliance"] = {1.0 / 3.0 * 1e-10};
  EXPECT_EQ(read_parameters(written(to_toml(set)), ParameterSet{}), set);
}

TEST(ParameterFile, HoldsCriterionAndVariationOfStrength) {
  for (const CriterionKind kind : {CriterionKind::element, CriterionKind::neighbourhood, CriterionKind::crack_band}) {
    ParameterSet set = default_parameters();
    set.strength_cv = 0.1;
    set.criterion.kind = kind;
    EXPECT_EQ(read_parameters(written(to_toml(set)), ParameterSet{}), set);
  }
  EXPECT_THAT(error_of("[toughness]\n\nstrength_cv = 0.01\n"), HasSubstr(".toml:3:"));
  EXPECT_THAT(error_of("[toughness]\nstrength_cv = 0.01\n"), HasSubstr("expected 0 or 0.02 to 0.4"));
  EXPECT_THAT(error_of("[toughness]\ncriterion = \"cohesive\"\n"), HasSubstr("expected one of element, neighbourhood"));
  EXPECT_THAT(error_of("[toughness]\ncriterion = \"crack_band\"\nsoftening = -1\n"), HasSubstr("softening"));
  EXPECT_THAT(error_of("[toughness]\ncriterium = 3\n"), HasSubstr("strength_cv, criterion"));
}

TEST(ParameterFile, AbsentKeysKeepTheStart) {
  const ParameterSet set = read_parameters(written("[modulus]\ne_vw_pa = 2e9\n"), default_parameters());
  ParameterSet expected = default_parameters();
  expected.modulus.e_vw_pa = 2e9;
  EXPECT_EQ(set, expected);
}

TEST(ParameterFile, ErrorsNameFileLineKeyAndWhatWasExpected) {
  const std::string negative = error_of("[modulus]\n\ne_vw_pa = -2e9\n");
  EXPECT_THAT(negative, HasSubstr(".toml:3:"));
  EXPECT_THAT(negative, HasSubstr("modulus.e_vw_pa"));
  EXPECT_THAT(negative, HasSubstr("expected a positive finite number"));
  EXPECT_THAT(error_of("[toughness]\nnu_tb = 0.51\n"),
              HasSubstr("toughness.nu_tb = 0.51: expected a number from 0 to 0.5"));
  EXPECT_THAT(error_of("[toughness]\ne_tb_pa = \"soft\"\n"), HasSubstr("toughness.e_tb_pa"));
  EXPECT_THAT(error_of("[toughness]\ne_tb_pa = nan\n"), HasSubstr("positive finite"));
  EXPECT_THAT(error_of("[modulus]\nw_tb_j_per_m3 = 1e5\n"), HasSubstr("unknown key, expected one of e_tb_pa"));
  EXPECT_THAT(error_of("[moduls]\n"), HasSubstr("unknown table, expected modulus"));
  EXPECT_THAT(error_of("modulus = 3\n"), HasSubstr("expected a table"));
  EXPECT_THAT(error_of("[modulus]\ne_vw_pa = = 3\n"), HasSubstr(".toml:2:"));
  EXPECT_THAT(error_of("[extension.warp_drive]\nvalue = 1\n"),
              HasSubstr("unknown extension, expected one of interface_anisotropy"));
  EXPECT_THAT(error_of("[extension.droplet_mixing]\nvalue = -1\n"), HasSubstr("pixels"));
  EXPECT_THAT(error_of("[extension.droplet_mixing]\nvalues = 1\n"), HasSubstr("the key value"));
  EXPECT_THAT(error_of("[extension.droplet_mixing]\nvalue = [1, 2]\n"), HasSubstr("expected 1 number"));
}

TEST(ParameterFile, AMissingFileIsNamed) {
  EXPECT_THROW((void)read_parameters("/nowhere/p.toml", default_parameters()), InputError);
}

TEST(ParameterFault, NamesWhatTheTestersCannotCompute) {
  const auto fault = [](auto change) {
    ParameterSet set = default_parameters();
    change(set);
    return parameter_fault(set);
  };
  EXPECT_THAT(fault([](ParameterSet& s) { s.modulus.e_tb_pa = 0.0; }), HasSubstr("modulus.e_tb_pa = 0"));
  EXPECT_THAT(fault([](ParameterSet& s) { s.modulus.nu_if = 0.6; }), HasSubstr("modulus.nu_if"));
  EXPECT_THAT(fault([](ParameterSet& s) { s.toughness.w_if_j_per_m3 = -1.0; }), HasSubstr("toughness.w_if_j_per_m3"));
  EXPECT_THAT(fault([](ParameterSet& s) { s.toughness.e_vw_pa = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("finite"));
  EXPECT_THAT(fault([](ParameterSet& s) { s.extensions["no_such"] = {1.0}; }),
              HasSubstr("unknown extension 'no_such'"));
  EXPECT_THAT(fault([](ParameterSet& s) { s.extensions["droplet_mixing"] = {99.0}; }), HasSubstr("expected 0 to"));
  EXPECT_THAT(fault([](ParameterSet& s) { s.extensions["droplet_mixing"] = {}; }), HasSubstr("takes 1"));
}

TEST(Effects, AreNamedOnceWithUnitsAndRangesAroundZero) {
  std::vector<std::string_view> names;
  for (const Effect& effect : effect_library()) {
    names.push_back(effect.name);
    EXPECT_FALSE(effect.family.empty() || effect.explanation.empty()) << effect.name;
    EXPECT_TRUE(effect.acts_on_modulus || effect.acts_on_toughness) << effect.name;
    ASSERT_FALSE(effect.parameters.empty());
    for (const EffectParameter& parameter : effect.parameters) {
      EXPECT_FALSE(parameter.meaning.empty() || parameter.unit.empty());
      EXPECT_LE(parameter.minimum, 0.0);  // zero is the base model
      EXPECT_GT(parameter.maximum, 0.0);
    }
    EXPECT_EQ(find_effect(effect.name), &effect);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(find_effect("no_such"), nullptr);
}

TEST(Effects, AbsentOnesAreZero) {
  const Extensions extensions = {{"droplet_mixing", {0.5}}};
  EXPECT_EQ(extension_value(extensions, "droplet_mixing"), 0.5);
  EXPECT_EQ(extension_value(extensions, "droplet_mixing", 1), 0.0);
  EXPECT_EQ(extension_value(extensions, "interface_anisotropy"), 0.0);
}

}  // namespace
}  // namespace nacre::material
