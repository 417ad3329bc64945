#include "measurement/pauses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "measurement/read_set.hpp"

namespace nacre::measurement {
namespace {

/// To 2 % and 20 MPa, there down to 15 MPa, back to zero force at 0.6 %, down to 0.2 %.
tester::Curve held_and_unloaded() {
  return {.strain = {0.0, 0.005, 0.01, 0.015, 0.02, 0.02, 0.02, 0.02, 0.014, 0.01, 0.006, 0.004, 0.002},
          .stress_pa = {0.0, 5e6, 1e7, 1.5e7, 2e7, 1.8e7, 1.6e7, 1.5e7, 8e6, 4e6, 0.0, 0.0, 0.0}};
}

TEST(Pauses, AreReadWhereTheStrainStandsAndWhereTheForceHasGone) {
  const PauseReadings readings = read_pauses(held_and_unloaded(), {{0.02}, {60.0}, 600.0});
  EXPECT_NEAR(readings.held_share.value(), 0.75, 1e-12);
  EXPECT_NEAR(readings.set_share.value(), 0.3, 1e-12);
  EXPECT_NEAR(readings.dwelled_share.value(), 0.1, 1e-12);
  EXPECT_EQ(first_pull(held_and_unloaded()).size(), 5u);
}

// Rows that are dense or coarse, that stop above zero or pass it, tell one set.
TEST(Pauses, AtZeroForceLieOnTheLineOfTheUnloading) {
  for (const int rows : {3, 7, 40, 400}) {
    for (const double least : {0.008, 0.0, -0.02}) {
      tester::Curve curve{.strain = {0.0, 0.01, 0.02}, .stress_pa = {0.0, 1e7, 2e7}};
      for (int i = 1; i <= rows; ++i) {
        const double force = 1.0 - (1.0 - least) * i / rows;
        curve.strain.push_back(0.006 + 0.014 * force);
        curve.stress_pa.push_back(2e7 * force);
      }
      EXPECT_NEAR(read_pauses(curve, {{0.02}, {}, 0.0}).set_share.value(), 0.3, 1e-9) << rows << " " << least;
    }
  }
}

TEST(Pauses, ThatTheProgrammeOrTheCurveLacksAreNotRead) {
  const PauseReadings only_held = read_pauses(held_and_unloaded(), {{0.02}, {60.0}});
  EXPECT_TRUE(only_held.held_share && !only_held.set_share && !only_held.dwelled_share);
  EXPECT_FALSE(read_pauses(held_and_unloaded(), {{0.02}, {}, 0.0}).dwelled_share);
  tester::Curve loaded = held_and_unloaded();
  loaded.strain.resize(10), loaded.stress_pa.resize(10);
  EXPECT_FALSE(read_pauses(loaded, {{0.02}, {60.0}, 600.0}).set_share) << "force is left";
}

TEST(Pauses, OfASetAreCheckedWithWhatWasExpected) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("nacre-pauses-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "c.csv") << "strain,stress_pa\n0,0\n0.005,5e6\n0.01,1e7\n0.015,1.5e7\n0.02,2e7\n0.02,1e7\n";
  std::ofstream(folder / "measurements.csv") << "specimen,pattern,test,curve,loading\n"
                                                "a,rigid,tensile,c.csv,strain 0.02 hold 60\n"
                                                "b,rigid,tensile,c.csv,monotonic\n"
                                                "c,rigid,tensile,c.csv,strain 0.02 hold\n";
  const MeasurementSet set = read_measurement_set(folder);
  std::filesystem::remove_all(folder);
  ASSERT_EQ(set.specimens.size(), 2u);
  EXPECT_TRUE(pauses_of(set.specimens[0])->has_pauses());
  EXPECT_FALSE(pauses_of(set.specimens[1])->has_pauses());
  ASSERT_EQ(set.rejected.size(), 1u);
  EXPECT_EQ(set.rejected[0].column, "loading");
  EXPECT_THAT(set.rejected[0].reason, testing::HasSubstr("expected \"monotonic\""));
}

}  // namespace
}  // namespace nacre::measurement
