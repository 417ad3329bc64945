#include "material/temperature_shift.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre::material {
namespace {

const Extensions kUniversal = {{"temperature_shift", {8.86 / 101.6, 101.6}}};

// Williams, Landel, Ferry (1955), equation 1 with their universal constants.
TEST(TemperatureShift, IsTheEquationOfWilliamsLandelAndFerry) {
  for (const double temperature_c : {-20.0, 23.0, 40.0, 90.0}) {
    const double above = temperature_c - 23.0;
    EXPECT_NEAR(std::log10(equivalent_rate(1e-3, kUniversal, temperature_c)), -3.0 - 8.86 * above / (101.6 + above),
                1e-9);
  }
}

TEST(TemperatureShift, WarmIsSlowAndColdBeforeThePoleIsFast) {
  EXPECT_LT(equivalent_rate(1.0, kUniversal, 60.0), 1e-2);
  EXPECT_GT(equivalent_rate(1.0, kUniversal, 0.0), 1e2);
  EXPECT_EQ(equivalent_rate(1.0, kUniversal, -200.0), equivalent_rate(1.0, kUniversal, 23.0 - 0.9 * 101.6));
}

TEST(TemperatureShift, WithoutItEveryTemperatureIsTheSame) {
  EXPECT_EQ(equivalent_rate(3e-4, {}, 80.0), 3e-4);
  EXPECT_EQ(equivalent_rate(3e-4, {{"temperature_shift", {0.0, 100.0}}}, 80.0), 3e-4);
}

}  // namespace
}  // namespace nacre::material
