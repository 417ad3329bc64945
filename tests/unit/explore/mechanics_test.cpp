#include "explore/mechanics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../pattern/random_patterns.hpp"
#include "base/statistics.hpp"
#include "explore/predictors.hpp"

namespace nacre::explore {
namespace {

using pattern::random_patterns;

TEST(Mechanics, UnitCellsPredictTheModuliOfPatternsThatNobodySimulated) {
  const material::ParameterSet parameters = material::thesis_parameters();
  const Mechanics mechanics = mechanics_by_tester(parameters, tester::Fidelity::preview, 1);
  const auto learnt = random_patterns(30, 1), unseen = random_patterns(60, 2);
  const auto moduli_of = [&](const std::vector<pattern::Pattern>& patterns) {
    std::vector<double> moduli;
    for (const auto& modulus_pa : mechanics.modulus_of(patterns)) moduli.push_back(modulus_pa.value());
    return moduli;
  };
  std::vector<Evaluated> samples;
  const std::vector<double> known = moduli_of(learnt), truth = moduli_of(unseen);
  for (std::size_t i = 0; i < learnt.size(); ++i) samples.push_back({learnt[i], {known[i], 1e5}});
  const auto rank_with = [&](const Mechanics& given) {
    SearchSettings settings;
    settings.algorithm = "learned";
    settings.mechanics = given;
    return rank_correlation(fit_predictors(samples, settings).modulus->means(unseen), truth);
  };
  EXPECT_GT(rank_with(mechanics), 0.99);
  EXPECT_GT(rank_with(mechanics), rank_with({}) + 0.03);
}

TEST(Mechanics, AreThoseOfTheModelAskedAboutOnAnyNumberOfThreads) {
  const auto patterns = random_patterns(12, 3);
  const material::ParameterSet parameters = material::thesis_parameters();
  material::ParameterSet softer = parameters;
  softer.modulus.e_vw_pa *= 0.5;
  softer.toughness.w_vw_j_per_m3 *= 0.5;
  const auto one = mechanics_by_tester(parameters, tester::Fidelity::preview, 1);
  const auto other = mechanics_by_tester(softer, tester::Fidelity::preview, 1);
  const auto again = mechanics_by_tester(parameters, tester::Fidelity::preview, 2);
  const Eigen::MatrixXd loads = one.cell_loads(patterns);
  ASSERT_EQ(loads.rows(), 12);
  EXPECT_EQ(one.cell_modulus(patterns).cols(), 1);
  EXPECT_TRUE((other.cell_modulus(patterns).array() < one.cell_modulus(patterns).array()).all());
  EXPECT_TRUE((other.cell_loads(patterns).rightCols(16).array() > loads.rightCols(16).array() - 1e-12).all());
  EXPECT_EQ(again.cell_loads(patterns), loads);
  EXPECT_EQ(again.cell_modulus(patterns), one.cell_modulus(patterns));
}

}  // namespace
}  // namespace nacre::explore
