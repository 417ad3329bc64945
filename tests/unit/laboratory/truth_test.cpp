#include "laboratory/truth.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "laboratory/laboratory_file.hpp"
#include "material/criterion_strengths.hpp"
#include "material/ranges.hpp"

namespace nacre::laboratory {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view toml) {
  try {
    parse_laboratory(toml, "lab.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Truth, TheSameSeedDrawsTheSameTruthAndAnotherSeedAnother) {
  EXPECT_EQ(draw_truth(5, tester::Fidelity::full), draw_truth(5, tester::Fidelity::full));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_NE(draw_truth(seed, tester::Fidelity::full).modulus, draw_truth(seed + 1, tester::Fidelity::full).modulus);
  }
}

TEST(Truth, EveryDrawLiesInsideTheRangesThatCalibrationSearches) {
  const auto modulus_ranges = material::thesis_ranges().modulus(material::FitTarget::microstructures);
  const auto toughness_ranges = material::thesis_ranges().toughness(material::FitTarget::microstructures);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto theta = material::to_vector(draw_modulus_parameters(seed));
    for (std::size_t i = 0; i < theta.size(); ++i) {
      EXPECT_GE(theta[i], modulus_ranges[i].minimum) << modulus_ranges[i].name;
      EXPECT_LE(theta[i], modulus_ranges[i].maximum) << modulus_ranges[i].name;
    }
    const auto eta = material::to_vector(draw_toughness_parameters(seed));
    for (std::size_t i = 0; i < eta.size(); ++i) {
      EXPECT_GE(eta[i], toughness_ranges[i].minimum) << toughness_ranges[i].name;
      EXPECT_LE(eta[i], toughness_ranges[i].maximum) << toughness_ranges[i].name;
    }
  }
}

TEST(Truth, NoneOneOrTwoEffectsAreDrawnAsOftenAsDeclared) {
  int counts[3] = {0, 0, 0};
  std::set<std::string_view> seen;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const HiddenEffects effects = draw_effects(seed);
    int count = 0;
    for (const EffectKind& kind : effect_kinds()) {
      if (effects.*kind.value == 0.0) continue;
      ++count;
      seen.insert(kind.name);
      EXPECT_GE(std::abs(effects.*kind.value), kind.drawn_minimum);
      EXPECT_LE(std::abs(effects.*kind.value), kind.drawn_maximum);
    }
    ASSERT_LE(count, 2);
    ++counts[count];
  }
  EXPECT_NEAR(counts[0], 300, 60);  // four standard deviations
  EXPECT_NEAR(counts[1], 500, 64);
  EXPECT_EQ(seen.size(), 5u);  // those that are drawn unasked
}

TEST(LaboratoryFile, WrittenTruthReadsBackToTheLastBit) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Truth truth = draw_truth(seed, tester::Fidelity::preview);
    if (seed % 2 == 1) truth.coupons = draw_coupon_ratios(seed);
    EXPECT_EQ(parse_laboratory(to_toml(truth), "truth"), truth);
  }
}

TEST(LaboratoryFile, CriterionAndVariationOfStrengthStandWithEta) {
  Truth truth = draw_truth(3, tester::Fidelity::preview);
  for (const material::CriterionKind kind :
       {material::CriterionKind::neighbourhood, material::CriterionKind::crack_band}) {
    truth.criterion = {.kind = kind};
    truth.strength_cv = 0.13;
    EXPECT_EQ(parse_laboratory(to_toml(truth), "truth"), truth);
  }
  for (const char* fault : {"strength_cv = 0.01", "strength_cv = 0.5", "criterion = \"cohesive\"",
                            "criterion = \"neighbourhood\"\nradius_m = 0.0"})
    EXPECT_THROW((void)parse_laboratory(fmt::format("[toughness]\n{}\n", fault), "lab.toml"), InputError) << fault;
}

TEST(LaboratoryFile, AbsentTablesAreDrawnFromTheSeedAndGivenKeysReplaceThem) {
  const Truth truth = parse_laboratory("seed = 9\nfidelity = \"preview\"\n[modulus]\ne_if_pa = 6e8\n", "lab.toml");
  material::ModulusParameters expected = draw_modulus_parameters(9);
  expected.e_if_pa = 6e8;
  EXPECT_EQ(truth.modulus, expected);
  EXPECT_EQ(truth.criterion, material::base_criterion());
  EXPECT_EQ(truth.toughness, material::with_strengths(draw_toughness_parameters(9),
                                                      material::strength_ratio(material::base_criterion())));
  EXPECT_EQ(truth.strength_cv, draw_strength_cv(9));
  EXPECT_EQ(truth.effects, HiddenEffects{});
  EXPECT_EQ(truth.fidelity, tester::Fidelity::preview);
}

TEST(LaboratoryFile, AnEffectWithoutValueOrNamedDrawIsDrawnFromTheSeed) {
  const Truth named = parse_laboratory("seed = 4\n[[effect]]\nname = \"droplet_mixing\"\n", "lab.toml");
  const Truth drawn =
      parse_laboratory("seed = 4\n[[effect]]\nname = \"droplet_mixing\"\nvalue = \"draw\"\n", "lab.toml");
  const auto kind = std::ranges::find(effect_kinds(), "droplet_mixing", &EffectKind::name);
  EXPECT_GE(named.effects.droplet_mixing_pixels, kind->drawn_minimum);
  EXPECT_LE(named.effects.droplet_mixing_pixels, kind->drawn_maximum);
  EXPECT_EQ(named.effects, drawn.effects);
  EXPECT_EQ(parse_laboratory("seed = 4\n[[effect]]\nname = \"draw\"\n", "lab.toml").effects, draw_effects(4));
}

TEST(LaboratoryFile, RefusalsNameFileLineKeyAndWhatWasExpected) {
  EXPECT_THAT(refusal("seed = 1\nreplicate = 3\n"), HasSubstr("lab.toml:2:13: replicate = 3: expected one of"));
  EXPECT_THAT(refusal("seed = -1\n"), HasSubstr(":1:8: seed = -1: expected a whole number from 0"));
  EXPECT_THAT(refusal("fidelity = \"huge\"\n"),
              HasSubstr(":1:12: fidelity = 'huge': expected tiny, preview, full or fine"));
  EXPECT_THAT(refusal("[noise]\nmodulus = 2\n"),
              HasSubstr(":2:11: noise.modulus = 2: expected a number from 0 to 0.5"));
  EXPECT_THAT(refusal("[noise]\nmodulus = \"much\"\n"), HasSubstr(":2:11: noise.modulus = 'much': expected a number"));
  EXPECT_THAT(refusal("[modulus]\nnu_tb = 0.7\n"),
              HasSubstr(":2:9: modulus.nu_tb = 0.7: expected a number from 0 to 0.5"));
  EXPECT_THAT(
      refusal("[toughness]\ne_xx = 1\n"),
      HasSubstr(":2:8: toughness.e_xx = 1: expected one of strength_cv, criterion, radius_m, softening, e_tb_pa"));
  EXPECT_THAT(refusal("[[effect]]\nname = \"magic\"\nvalue = 1\n"),
              HasSubstr(":2:8: effect.name = 'magic': expected one of draw, machine_comp"));
  EXPECT_THAT(refusal("[[effect]]\nvalue = 1\n"), HasSubstr("effect.name: expected one of"));
  EXPECT_THAT(refusal("[[effect]]\nname = \"corner_debonding\"\nvalue = 1.5\n"),
              HasSubstr(":3:9: effect.value = 1.5: expected a number"));
  EXPECT_THAT(refusal("[[effect]]\nname = \"toe_slack\"\n[[effect]]\nname = \"toe_slack\"\n"),
              HasSubstr("each effect once"));
  EXPECT_THAT(refusal("seed 1\n"), HasSubstr("lab.toml:1:6: not TOML"));
}

TEST(LaboratoryFile, OneWithoutASeedIsAnotherLaboratoryInEveryGame) {
  constexpr std::string_view kAnisotropic = "[[effect]]\nname = \"interface_anisotropy\"\nvalue = 0.5\n";
  const Truth second = parse_laboratory(kAnisotropic, "lab.toml", 2),
              third = parse_laboratory(kAnisotropic, "lab.toml", 3);
  EXPECT_EQ(second.modulus, draw_modulus_parameters(2));
  EXPECT_NE(second.modulus, third.modulus);
  EXPECT_EQ(second.effects, third.effects);
  EXPECT_EQ(parse_laboratory("seed = 4\n", "lab.toml", 2).seed, 4);
}

TEST(SealedTruth, OnlyItsOwnerMayReadIt) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "sealed.truth.toml";
  const Truth truth = draw_truth(8, tester::Fidelity::full);
  write_sealed(file, truth);
  write_sealed(file, truth);  // a restarted laboratory seals again
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0400u);
  EXPECT_EQ(read_laboratory(file), truth);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace nacre::laboratory
