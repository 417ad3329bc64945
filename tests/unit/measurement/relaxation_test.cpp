// Stress relaxation as machines for dynamic mechanical analysis and tensile tests write it.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "layouts.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/piece.hpp"
#include "measurement/read_set.hpp"
#include "measurement/write_import.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The material of all tests: E(t) = 2 MPa t^-0.2.
double modulus_at(double time_s) { return 2e6 * std::pow(time_s, -0.2); }

class Relaxations : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-relaxation-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Import import(const std::string& text, const std::string& columns = "", const std::string& cells = "",
                const std::string& design = "mix:0.25,modulus") const {
    std::ofstream(folder_ / "a.csv") << text;
    std::ofstream(folder_ / "sheet.csv") << "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm" << columns
                                         << "\na.csv,s," << design << ",6,2,20" << cells << "\n";
    return import_exports({}, folder_ / "sheet.csv");
  }

  /// Rows of one piece with the moduli of the material after their holds.
  static void expect_material(const Import& import, std::size_t rows, double tolerance) {
    ASSERT_EQ(import.specimens.size(), rows) << all_of(import);
    for (const ImportedSpecimen& one : import.specimens) {
      const double hold_s = std::stod(one.record.other_columns.at("hold_s"));
      EXPECT_EQ(piece_of(one.record), "s");
      EXPECT_NEAR(one.record.modulus_pa.value() / modulus_at(hold_s), 1.0, tolerance) << hold_s << all_of(import);
      EXPECT_NEAR(one.record.conditions.strain_rate_per_s * hold_s, 1.375e-3, 1e-8);
    }
  }
  void expect_refused(const Import& import, const std::string& column, const std::string& expected) const {
    EXPECT_TRUE(import.specimens.empty());
    ASSERT_EQ(import.rejected.size(), 1U) << all_of(import);
    EXPECT_EQ(import.rejected[0].column, column);
    EXPECT_THAT(import.rejected[0].reason, HasSubstr(expected));
  }
  fs::path folder_;
};

/// {0} s, {1} min, {2} MPa, {3} kPa of stress at 0.5 % strain.
std::string table_of(const std::string& heading, const std::string& format) {
  std::string text = heading;
  for (const double time_s : {1.0, 3.0, 10.0, 30.0, 100.0})
    text +=
        fmt::format(fmt::runtime(format), time_s, time_s / 60.0, 1e-6 * modulus_at(time_s), 5e-6 * modulus_at(time_s));
  return text;
}

TEST_F(Relaxations, AreReadFromTablesOfManyLayouts) {
  expect_material(import(table_of("Time (s),Relaxation modulus (MPa)\n", "{0},{2}\n")), 5, 1e-5);
  expect_material(
      import(table_of("Step time,Relaxation modulus,Strain,Temperature\nmin,MPa,%,°C\n", "{1},{2},0.5,23.1\n")), 5,
      1e-5);
  expect_material(import(table_of("Zeit / s;Relaxationsmodul / MPa\n", "{0};{2}\n")), 5, 1e-5);
  expect_material(import(table_of("t [s]\tE(t) [MPa]\n", "{0}\t{2}\n")), 5, 1e-5);
}

TEST_F(Relaxations, OfStressNeedTheStrainOfTheSheet) {
  const std::string text = table_of("Time (s),Stress (kPa)\n", "{0},{3}\n");
  expect_material(import(text, ",strain_amplitude", ",0.005"), 5, 1e-5);
  expect_refused(import(text), "strain_amplitude", "expected the strain that was held");
}

TEST_F(Relaxations, AtOneTemperatureAfterAnotherAreRowsOfOnePiece) {
  std::string text = "Time (s),Relaxation modulus (MPa),Temperature (°C)\n";
  for (const int temperature_c : {10, 20, 30})
    for (const double time_s : {1.0, 10.0, 100.0})
      text += fmt::format("{},{},{}\n", time_s, 1e-6 * modulus_at(time_s), temperature_c);
  const Import all = import(text);
  expect_material(all, 9, 1e-5);
  EXPECT_EQ(all.specimens[3].record.other_columns.at("temperature_c"), "20");
}

/// Time, extension, force of a strain of 1 % that is reached in two seconds and held to 1000 s.
std::string record_of_machine() {
  constexpr double kRampS = 2.0, kExponent = 0.2;
  const auto integral = [](double time_s) {
    return time_s > 0.0 ? std::pow(time_s, 1.0 - kExponent) / (1.0 - kExponent) : 0.0;
  };
  std::string text = "Time (s),Extension (mm),Load (N)\n";
  for (double time_s = 0.0; time_s < 1000.0; time_s += time_s < 10.0 ? 0.1 : 0.5) {
    const double strain = 0.01 * std::min(1.0, time_s / kRampS);
    const double stress_pa = 0.01 / kRampS * 2e6 * (integral(time_s) - integral(time_s - kRampS));
    text += fmt::format("{:.1f},{:.6f},{:.6f}\n", time_s, 20.0 * strain, stress_pa * 12e-6);
  }
  return text;
}

// Boltzmann's integral over the ramp: E(t) counts from its middle, and a ramp's duration after its end the difference
// is below 1 %. A handful of times is left of 2000.
TEST_F(Relaxations, OfATensileMachineCountFromTheMiddleOfTheRamp) {
  const Import one = import(record_of_machine());
  expect_material(one, 5, 0.01);
  EXPECT_GT(std::stod(one.specimens[0].record.other_columns.at("hold_s")), 3.0) << "nothing of the ramp";
  EXPECT_THAT(all_of(one), HasSubstr("stress relaxation at strain 0.01 after a ramp of 2 s"));
}

TEST_F(Relaxations, AreNoPullsToBreakAndNoLayouts) {
  expect_refused(import(table_of("Time (s),Relaxation modulus (MPa)\n", "{0},{2}\n"), "", "", "mix:0.25,tensile"),
                 "test", "expected the test `modulus`");
  expect_refused(import(table_of("Time (s),Relaxation modulus (MPa)\n", "{0},{2}\n"), "", "", "577fffe9fffdef,modulus"),
                 "pattern", "expected a homogeneous material");
  expect_refused(import(table_of("Time (s),Shear relaxation modulus (MPa)\n", "{0},{2}\n")),
                 "Shear relaxation modulus (MPa)", "in shear");
  expect_refused(import(table_of("Time (s),Relaxation modulus\n", "{0},{2}\n")), "Relaxation modulus", "has no unit");
}

TEST_F(Relaxations, AreWrittenIntoASetThatReadsBack) {
  Import all = import(table_of("Time (s),Relaxation modulus (MPa)\n", "{0},{2}\n"));
  write_import(folder_ / "set", (folder_ / "sheet.csv").string(), all);
  const MeasurementSet set = read_measurement_set(folder_ / "set");
  ASSERT_EQ(set.specimens.size(), 5u);
  EXPECT_TRUE(set.rejected.empty());
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(set.specimens[i], all.specimens[i].record);
}

TEST_F(Relaxations, OfASetAreCheckedAndGetTheirRate) {
  std::ofstream(folder_ / "measurements.csv") << "specimen,pattern,test,modulus_pa,strain_rate_per_s,hold_s\n"
                                                 "a,soft,modulus,1e6,,10\n"
                                                 "b,soft,modulus,1e6,1e-3,10\n"
                                                 "c,soft,modulus,1e6,,long\n"
                                                 "d,577fffe9fffdef,modulus,1e6,,10\n";
  const MeasurementSet set = read_measurement_set(folder_);
  ASSERT_EQ(set.specimens.size(), 1u);
  EXPECT_DOUBLE_EQ(set.specimens[0].conditions.strain_rate_per_s, 1.375e-4);
  ASSERT_EQ(set.rejected.size(), 3u);
  EXPECT_EQ(set.rejected[0].column, "strain_rate_per_s");
  EXPECT_THAT(set.rejected[0].reason, HasSubstr("expected an empty cell or 0.0001375"));
  EXPECT_EQ(set.rejected[1].column, "hold_s");
  EXPECT_THAT(set.rejected[1].reason, HasSubstr("expected a time in s"));
  EXPECT_THAT(set.rejected[2].reason, HasSubstr("homogeneous"));
}

TEST(HeldStretch, BeginsWhereTheRampEndsAndIsTheLongest) {
  std::vector<double> time_s, strain;
  for (int i = 0; i < 40; ++i) {
    time_s.push_back(i);
    strain.push_back(i < 5 ? 0.002 * i : i < 30 ? 0.01 + 1e-5 * (i % 2) : 0.0);
  }
  const auto held = held_stretch(time_s, strain);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->first, 5u);
  EXPECT_EQ(held->end, 30u);
  EXPECT_DOUBLE_EQ(held->begin_s, 2.5);
  EXPECT_FALSE(is_relaxation(*held, time_s)) << "it is unloaded afterwards";
  EXPECT_FALSE(held_stretch(time_s, std::vector<double>(40, 0.0)));
}

}  // namespace
}  // namespace nacre::measurement
