// The field of strengths in which specimens of one design differ, and the mean of T over them.

#include "tester/strength_field.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/statistics.hpp"
#include "tester/assembly.hpp"
#include "tester/expected_toughness.hpp"
#include "tester/fracture_test.hpp"
#include "tester/notch.hpp"
#include "tester/usable.hpp"

namespace nacre::tester {
namespace {

/// Of specimen 0.
Simulation of_cv(double strength_cv, Fidelity fidelity = Fidelity::tiny) {
  Simulation simulation{.design = pattern::design_from_name("577fffe9fffdef").value(),
                        .parameters = material::thesis_parameters(),
                        .conditions = {},
                        .fidelity = fidelity};
  simulation.parameters.strength_cv = strength_cv;
  return simulation;
}

/// Of the notched specimen, element by element.
std::vector<double> thresholds(Simulation simulation, int specimen) {
  simulation.specimen = specimen;
  return fracture_test(simulation).grid.threshold_j_per_m3;
}

/// Factors of the field, element by element of the whole specimen.
std::vector<double> factors(Simulation simulation, int specimen = 0, int refinement = 1) {
  const SpecimenUnits units = toughness_units(simulation.fidelity);
  fem::Grid grid = assemble(simulation.design, simulation.parameters, simulation.conditions, AssemblyTarget::toughness,
                            units.x, units.y, refinement);
  std::vector<double> result = grid.threshold_j_per_m3;
  simulation.specimen = specimen;
  draw_strengths(grid, refinement, simulation);
  for (std::size_t e = 0; e < result.size(); ++e) result[e] = grid.threshold_j_per_m3[e] / result[e];
  return result;
}

TEST(StrengthField, HasMeanOneAndTheDeclaredVariation) {
  for (const double cv : {0.02, 0.1, 0.4}) {
    std::vector<double> all;
    for (int specimen = 0; specimen < 10; ++specimen)
      for (const double factor : factors(of_cv(cv), specimen)) all.push_back(factor);
    ASSERT_EQ(all.size(), 16000U);
    EXPECT_NEAR(mean(all), 1.0, 4.0 * cv / std::sqrt(16000.0));
    EXPECT_NEAR(standard_deviation(all), cv, 0.04 * cv);
  }
}

TEST(StrengthField, IsLogNormalWithIndependentRegions) {
  std::vector<double> logs, neighbours;
  for (const double factor : factors(of_cv(0.2, Fidelity::preview))) logs.push_back(std::log(factor));
  EXPECT_NEAR(mean(logs), -0.5 * std::log1p(0.04), 0.005);
  int within_one = 0;
  const double s = std::sqrt(std::log1p(0.04)), middle = mean(logs);
  for (const double value : logs) within_one += std::abs(value - middle) < s ? 1 : 0;
  EXPECT_NEAR(within_one / 32000.0, 0.6827, 0.01);
  for (std::size_t e = 1; e < logs.size(); ++e) neighbours.push_back((logs[e] - middle) * (logs[e - 1] - middle));
  EXPECT_NEAR(mean(neighbours) / (s * s), 0.0, 4.0 / std::sqrt(32000.0));
}

TEST(StrengthField, IsTheSameOnEveryMesh) {
  const std::vector<double> coarse = factors(of_cv(0.1), 3);
  for (const int refinement : {2, 3}) {
    const std::vector<double> fine = factors(of_cv(0.1), 3, refinement);
    const int side = 40 * refinement;
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        ASSERT_NEAR(fine[row * side + column], coarse[row / refinement * 40 + column / refinement], 1e-12);
  }
}

TEST(StrengthField, KnowsNeitherParametersNorFidelityAndScalesWithTheVariation) {
  const Simulation preview = of_cv(0.1, Fidelity::preview);
  EXPECT_EQ(factors(preview), factors(of_cv(0.1, Fidelity::full)));
  Simulation other = preview;
  other.parameters.toughness.w_vw_j_per_m3 *= 3.0;
  other.parameters.toughness.e_tb_pa *= 0.5;
  const std::vector<double> own = factors(preview), theirs = factors(other),
                            wide = factors(of_cv(0.3, Fidelity::preview));
  const double s = std::sqrt(std::log1p(0.01)), s_wide = std::sqrt(std::log1p(0.09));
  for (std::size_t e = 0; e < own.size(); ++e) {
    ASSERT_NEAR(own[e], theirs[e], 1e-12);
    ASSERT_NEAR(std::log(own[e]) / s + 0.5 * s, std::log(wide[e]) / s_wide + 0.5 * s_wide, 1e-9) << "the same z";
  }
}

TEST(StrengthField, DiffersBetweenSpecimensDesignsAndOrientations) {
  const Simulation usual = of_cv(0.1);
  Simulation turned = usual, other = usual;
  turned.conditions.orientation_deg = 90.0;
  other.design = pattern::design_from_name("3ffc9b4ad4d2d9").value();
  EXPECT_EQ(factors(usual, 1), factors(usual, 1));
  EXPECT_NE(factors(usual, 1), factors(usual, 0));
  EXPECT_NE(factors(turned), factors(usual));
  EXPECT_NE(factors(other), factors(usual));
}

TEST(StrengthField, AtZeroIsTheUniformModelToTheBit) {
  const Simulation uniform = of_cv(0.0);
  fem::Grid grid = assemble(uniform.design, uniform.parameters, {}, AssemblyTarget::toughness, 1, 1);
  cut_notch(grid, 1);
  for (const int specimen : {0, 5}) EXPECT_EQ(thresholds(uniform, specimen), grid.threshold_j_per_m3);
}

TEST(StrengthField, IsInTheSpecimenThatIsPulled) {
  const std::vector<double> base = thresholds(of_cv(0.0), 2), drawn = thresholds(of_cv(0.1), 2),
                            field = factors(of_cv(0.1), 2);
  for (std::size_t e = 0; e < base.size(); ++e)
    ASSERT_TRUE(drawn[e] == base[e] || std::abs(drawn[e] / base[e] / field[e] - 1.0) < 1e-12) << e;
  EXPECT_NE(drawn, base);
}

TEST(StrengthField, OfAnImpossibleVariationIsRefused) {
  for (const double cv : {-0.1, 0.01, 0.41, std::nan("")}) {
    EXPECT_NE(simulation_fault(of_cv(cv), TestKind::toughness).find("0.02 to 0.4"), std::string::npos) << cv;
    EXPECT_FALSE(test_toughness(of_cv(cv)));
  }
  for (const double cv : {0.0, 0.02, 0.4}) EXPECT_EQ(simulation_fault(of_cv(cv), TestKind::toughness), "");
}

TEST(ExpectedToughness, IsTheArithmeticMeanWithItsStandardError) {
  std::vector<ToughnessResult> specimens(4);
  for (int i = 0; i < 4; ++i) specimens[i].toughness_pa = 1e5 * (i + 1);
  const ExpectedToughness expected = expected_toughness_of(specimens);
  EXPECT_DOUBLE_EQ(expected.toughness_pa, 2.5e5);
  EXPECT_DOUBLE_EQ(expected.toughness_sd_pa.value(), 1e5 * std::sqrt(5.0 / 3.0));
  EXPECT_DOUBLE_EQ(expected.toughness_se_pa.value(), 1e5 * std::sqrt(5.0 / 12.0));
  EXPECT_EQ(expected.specimens.size(), 4U);
  const ExpectedToughness of_one = expected_toughness_of({specimens[1]});
  EXPECT_EQ(of_one.toughness_pa, 2e5);
  EXPECT_FALSE(of_one.toughness_sd_pa || of_one.toughness_se_pa);
}

TEST(ExpectedToughness, IsTheSameBitsForAnyNumberOfThreads) {
  const ExpectedToughness alone = expected_toughness(of_cv(0.1), 4, {}, 1).value();
  const ExpectedToughness three = expected_toughness(of_cv(0.1), 4, {}, 3).value();
  EXPECT_EQ(alone.toughness_pa, three.toughness_pa);
  EXPECT_EQ(alone.toughness_se_pa, three.toughness_se_pa);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(alone.specimens[i].curve, three.specimens[i].curve);
    EXPECT_EQ(alone.specimens[i].breaks, three.specimens[i].breaks);
  }
  EXPECT_NE(alone.specimens[0].toughness_pa, alone.specimens[1].toughness_pa);
  Simulation third = of_cv(0.1);
  third.specimen = 2;
  EXPECT_EQ(alone.specimens[2].curve, test_toughness(third).value().curve);
}

TEST(ExpectedToughness, WithoutAFieldIsThatOfTheOneSpecimenThereIs) {
  const ToughnessResult one = test_toughness(of_cv(0.0)).value();
  const ExpectedToughness expected = expected_toughness(of_cv(0.0), 2).value();
  EXPECT_EQ(expected.toughness_pa, one.toughness_pa);
  EXPECT_EQ(expected.toughness_se_pa, 0.0);
  EXPECT_EQ(expected.specimens[1].curve, one.curve);
}

TEST(ExpectedToughness, SaysWhichSpecimenCannotBeTested) {
  const auto refused = expected_toughness(of_cv(0.9), 2);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("specimen 0"), std::string::npos);
}

}  // namespace
}  // namespace nacre::tester
