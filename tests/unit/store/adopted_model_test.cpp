#include "store/adopted_model.hpp"

#include <gtest/gtest.h>

namespace nacre::store {
namespace {

TEST(AdoptedModel, TheLineOfMixturesIsShownAsTheMachineShowsIt) {
  RoundRecord round;
  round.benchmark = {{1e9, 1e5}, {2e9, 2e5}};
  EXPECT_EQ(line_as_measured(round).at(1).modulus_pa, 2e9);
  round.parameters["extension.machine_compliance"] = 1e-10;
  const auto line = line_as_measured(round);
  EXPECT_NEAR(line.at(0).modulus_pa, 1.0 / (1.0 / 1e9 + 1e-10), 1.0);
  EXPECT_NEAR(line.at(1).modulus_pa, 1.0 / (1.0 / 2e9 + 1e-10), 1.0);
}

TEST(AdoptedModel, EffectsOfTheMaterialLeaveTheLineAsItWasMeasured) {
  RoundRecord round;
  round.benchmark = {{1e9, 1e5}};
  round.parameters["extension.droplet_mixing"] = 0.7;
  EXPECT_EQ(line_as_measured(round).at(0).modulus_pa, 1e9);
  EXPECT_EQ(extensions_of(round).at("droplet_mixing"), std::vector<double>{0.7});
}

}  // namespace
}  // namespace nacre::store
