#include "material/surroundings_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre::material {
namespace {

TEST(SurroundingsLaws, EachMaterialHasAnExponentOfItsOwn) {
  const Extensions extensions = {{"humidity_dependence", {-0.005, -0.01}}, {"ageing", {0.1, 0.0}}};
  EXPECT_NEAR(stiffness_in_surroundings(extensions, 0, 80.0, 0.0), std::exp(-0.15), 1e-12);
  EXPECT_NEAR(stiffness_in_surroundings(extensions, 1, 80.0, 99.0), std::exp(-0.3), 1e-12);
  EXPECT_NEAR(stiffness_in_surroundings(extensions, 0, 50.0, 99.0), std::pow(100.0, 0.1), 1e-12);
}

TEST(SurroundingsLaws, WithoutThemNothingChanges) { EXPECT_EQ(stiffness_in_surroundings({}, 0, 90.0, 1000.0), 1.0); }

}  // namespace
}  // namespace nacre::material
