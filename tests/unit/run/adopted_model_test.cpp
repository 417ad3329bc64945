#include "run/adopted_model.hpp"

#include <gtest/gtest.h>

namespace nacre::run {
namespace {

RoundRecord round_with(const std::string& effect, double value) {
  RoundRecord round;
  round.model.emplace().benchmark = {{1e9, 1e5}, {2e9, 2e5}};
  if (!effect.empty()) round.model->parameters.extensions[effect] = {value};
  return round;
}

TEST(AdoptedModel, TheLineOfMixturesIsShownAsTheMachineShowsIt) {
  EXPECT_EQ(line_as_measured(round_with("", 0.0)).at(1).modulus_pa, 2e9);
  const auto line = line_as_measured(round_with("machine_compliance", 1e-10));
  EXPECT_NEAR(line.at(0).modulus_pa, 1.0 / (1.0 / 1e9 + 1e-10), 1.0);
  EXPECT_NEAR(line.at(1).modulus_pa, 1.0 / (1.0 / 2e9 + 1e-10), 1.0);
}

TEST(AdoptedModel, EffectsOfTheMaterialLeaveTheLineAsItWasMeasured) {
  const RoundRecord round = round_with("droplet_mixing", 0.7);
  EXPECT_EQ(line_as_measured(round).at(0).modulus_pa, 1e9);
  EXPECT_EQ(extensions_of(round).at("droplet_mixing"), std::vector<double>{0.7});
}

TEST(AdoptedModel, ARoundWithoutAModelHasNeitherLineNorExtensions) {
  EXPECT_TRUE(line_as_measured(RoundRecord{}).empty());
  EXPECT_TRUE(extensions_of(RoundRecord{}).empty());
}

TEST(AdoptedModel, ParametersHaveTheNamesOfTheirFile) {
  material::ParameterSet parameters = material::default_parameters();
  parameters.extensions = {{"machine_compliance", {4e-11}}, {"two_numbers", {1.0, 2.0}}};
  const auto named = named_parameters(parameters);
  EXPECT_EQ(named.at("modulus.e_tb_pa"), parameters.modulus.e_tb_pa);
  EXPECT_EQ(named.at("extension.machine_compliance"), 4e-11);
  EXPECT_EQ(named.at("extension.two_numbers.1"), 2.0);
}

}  // namespace
}  // namespace nacre::run
