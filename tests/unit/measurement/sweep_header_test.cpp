// Sweeps at one frequency, and amplitudes as lengths: what the lines above the table tell.

#include "measurement/sweep_header.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "layouts.hpp"
#include "measurement/import.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kRadians = 2.0 * std::numbers::pi;

class SweepHeaders : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-sweep-headers-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  Import import(const std::string& text, const std::string& amplitude = "") const {
    std::ofstream(folder_ / "a.csv") << text;
    std::ofstream(folder_ / "sheet.csv")
        << "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,strain_amplitude\na.csv,s,soft,modulus,6,2,20,"
        << amplitude << "\n";
    return import_exports({}, folder_ / "sheet.csv");
  }
  /// Three rows of a temperature ramp at 10 Hz and a strain amplitude of 0.1 %.
  static void expect_ramp(const Import& import) {
    ASSERT_EQ(import.specimens.size(), 3U) << all_of(import);
    const std::vector<std::string> temperatures = {"20", "25", "30"};
    for (std::size_t i = 0; i < 3; ++i) {
      const SpecimenRecord& record = import.specimens[i].record;
      EXPECT_NEAR(record.conditions.strain_rate_per_s, kRadians * 10.0 * 1e-3, 1e-5) << all_of(import);
      EXPECT_EQ(record.other_columns.at("temperature_c"), temperatures[i]);
      EXPECT_THAT(record.note, HasSubstr("E' at 10 Hz, amplitude 0.001"));
    }
  }
  fs::path folder_;
};

constexpr const char* kTemperatureRamp = "Temperature (C),E' (MPa),tan delta\n20,1.5,0.6\n25,1.2,0.65\n30,1.0,0.7\n";

TEST_F(SweepHeaders, OneFrequencyAboveTheTableIsThatOfAllRows) {
  for (const char* frequency : {"Frequency,10.0,Hz", "Frequency: 10 Hz", "Frequency (Hz),10", "Prüffrequenz: 10 Hz",
                                "Angular frequency,62.831853,rad/s", "Frequency [mHz]: 10000"}) {
    SCOPED_TRACE(frequency);
    expect_ramp(import(fmt::format("Instrument,DMA\n{}\nAmplitude: 0.1 %\n\n{}", frequency, kTemperatureRamp)));
    expect_ramp(import(fmt::format("{}\n{}", frequency, kTemperatureRamp), "0.001"));
  }
}

TEST_F(SweepHeaders, AStrainSweepHasARateForEachAmplitude) {
  const Import sweep = import("Frequency: 10 Hz\nStrain (%),Storage modulus (MPa)\n0.1,1.5\n1.0,1.2\n");
  ASSERT_EQ(sweep.specimens.size(), 2U) << all_of(sweep);
  EXPECT_NEAR(sweep.specimens[0].record.conditions.strain_rate_per_s, kRadians * 10.0 * 1e-3, 1e-5);
  EXPECT_NEAR(sweep.specimens[1].record.conditions.strain_rate_per_s, kRadians * 10.0 * 1e-2, 1e-4);
}

// 17.5 um of 17.5 mm.
TEST_F(SweepHeaders, AnAmplitudeAsALengthIsAStrainByTheSamplesLength) {
  for (const char* amplitude : {"Amplitude: 17.5 um", "Amplitude,0.0175,mm", "Oscillation displacement (µm): 17.5"}) {
    for (const char* length :
         {"Sample length: 17.5 mm", "Length,17.5,mm", "Gauge length (cm): 1.75", "Einspannlänge: 17,5 mm"}) {
      SCOPED_TRACE(fmt::format("{}; {}", amplitude, length));
      expect_ramp(import(fmt::format("{}\nFrequency: 10 Hz\n{}\n{}", length, amplitude, kTemperatureRamp)));
    }
  }
}

TEST_F(SweepHeaders, AColumnOfDisplacementToo) {
  const std::string rows = "10,1.5,17.5\n1,1.2,35\n";
  const Import sweep = import("Length: 17.5 mm\nFrequency (Hz),E' (MPa),Oscillation displacement (um)\n" + rows);
  ASSERT_EQ(sweep.specimens.size(), 2U) << all_of(sweep);
  EXPECT_NEAR(sweep.specimens[0].record.conditions.strain_rate_per_s, kRadians * 10.0 * 1e-3, 1e-5);
  EXPECT_NEAR(sweep.specimens[1].record.conditions.strain_rate_per_s, kRadians * 2e-3, 1e-6);
  EXPECT_THAT(sweep.specimens[0].decisions, testing::Contains(HasSubstr("17.5 mm in line 1 of the header")));
}

TEST_F(SweepHeaders, WithoutTheSamplesLengthItIsNoStrain) {
  for (const bool is_column : {true, false}) {
    const Import refused =
        import(is_column ? "Frequency (Hz),E' (MPa),Amplitude (um)\n10,1.5,17.5\n1,1.2,17.5\n"
                         : fmt::format("Frequency: 10 Hz\nAmplitude: 17.5 um\n{}", kTemperatureRamp));
    EXPECT_TRUE(refused.specimens.empty());
    ASSERT_EQ(refused.rejected.size(), 1U) << all_of(refused);
    EXPECT_EQ(refused.rejected[0].line, 2);
    EXPECT_EQ(refused.rejected[0].column, "strain_amplitude");
    EXPECT_THAT(refused.rejected[0].reason, HasSubstr(is_column ? "`a.csv` holds" : "in line 2 is a length"));
    EXPECT_THAT(refused.rejected[0].reason, HasSubstr("such as `Sample length: 17.5 mm`"));
  }
}

// Of two frequencies neither is that of the rows, and the ends of a range are none.
TEST_F(SweepHeaders, SeveralFrequenciesAreNone) {
  for (const char* frequency : {"Frequency 1: 1 Hz\nFrequency 2: 10 Hz", "Start frequency: 1 Hz", "Frequency: 10"}) {
    const Import refused = import(fmt::format("{}\n{}", frequency, kTemperatureRamp), "0.001");
    EXPECT_TRUE(refused.specimens.empty()) << frequency;
    ASSERT_EQ(refused.rejected.size(), 1U) << all_of(refused);
    EXPECT_THAT(refused.rejected[0].reason, HasSubstr("Frequency: 1 Hz")) << frequency;
  }
}

TEST_F(SweepHeaders, TablesBelowEachOtherHaveAFrequencyEach) {
  const Import sweep =
      import(fmt::format("Frequency: 10 Hz\nAmplitude: 0.1 %\n{0}\nFrequency: 1 Hz\n{0}", kTemperatureRamp));
  ASSERT_EQ(sweep.specimens.size(), 6U) << all_of(sweep);
  EXPECT_NEAR(sweep.specimens[0].record.conditions.strain_rate_per_s, kRadians * 10.0 * 1e-3, 1e-5);
  EXPECT_NEAR(sweep.specimens[5].record.conditions.strain_rate_per_s, kRadians * 1e-3, 1e-6);
}

}  // namespace
}  // namespace nacre::measurement
