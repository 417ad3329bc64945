#pragma once
// A synthetic test as exports of many layouts: what is read of it must be the usual values, or refused.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "measurement/import.hpp"

namespace nacre::measurement {

inline constexpr double kLayoutModulusPa = 1.2e9, kLayoutToughnessPa = 0.120e6, kLayoutRatePerS = 3.70e-4;

inline std::string all_of(const Import& import) {
  std::string text;
  for (const ImportFault& fault : import.rejected) text += to_string(fault) + "\n";
  for (const std::string& warning : import.warnings) text += warning + "\n";
  for (const ImportedSpecimen& one : import.specimens) {
    for (const std::string& decision : one.decisions) text += decision + "\n";
  }
  return text;
}

/// A specimen of E 1.2 GPa, 120 kJ/m3, pulled at 0.02 mm/s over 54 mm, as rows of numbers.
struct Point {
  double time_s, extension_mm, force_n;
};
inline std::vector<Point> usual_test(double scale = 1.0) {
  std::vector<Point> points;
  for (int i = 0; i <= 120; ++i) {
    const double extension = 1.296 * i / 120, peak = 0.54, area = 52 * 3.2;
    const double stress =
        extension <= peak ? 1200 * extension / 54 : std::max(0.0, 12.0 * (1 - (extension - peak) / 0.54));
    points.push_back({extension / 0.02, extension, scale * stress * area});
  }
  return points;
}

class Layouts : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("nacre-layouts-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Import import(const std::string& text, const std::string& columns = "", const std::string& cells = "") const {
    std::ofstream(folder_ / "a.csv") << text;
    std::ofstream(folder_ / "sheet.csv") << "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm" << columns
                                         << "\na.csv,s1,rigid,toughness,52,3.2,54" << cells << "\n";
    return import_exports({}, folder_ / "sheet.csv");
  }
  void expect_read(const std::string& text, const std::string& columns = "", const std::string& cells = "") const {
    const Import import = this->import(text, columns, cells);
    ASSERT_EQ(import.specimens.size(), 1U) << text.substr(0, 200) << "\n" << all_of(import);
    SCOPED_TRACE(text.substr(0, 200));
    EXPECT_NEAR(import.specimens[0].test.modulus_pa, kLayoutModulusPa, 0.005 * kLayoutModulusPa) << all_of(import);
    EXPECT_NEAR(import.specimens[0].test.toughness_pa, kLayoutToughnessPa, 0.005 * kLayoutToughnessPa);
    EXPECT_NEAR(import.specimens[0].record.conditions.strain_rate_per_s, kLayoutRatePerS, 0.005 * kLayoutRatePerS);
  }
  void expect_refused(const std::string& text, const std::string& reason, const std::string& columns = "",
                      const std::string& cells = "") const {
    const Import import = this->import(text, columns, cells);
    EXPECT_TRUE(import.specimens.empty()) << text.substr(0, 200);
    EXPECT_THAT(all_of(import), testing::HasSubstr(reason)) << text.substr(0, 200);
  }
  std::filesystem::path folder_;
};

/// Rows `format` of time, extension, force, under a heading.
inline std::string table(const std::string& heading, const std::string& format = "{:.3f},{:.5f},{:.4f}\n",
                         double extension = 1.0, double force = 1.0) {
  std::string text = heading;
  for (const Point& each : usual_test())
    text += fmt::format(fmt::runtime(format), each.time_s, extension * each.extension_mm, force * each.force_n);
  return text;
}

inline std::string with_commas(std::string text) {
  std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

}  // namespace nacre::measurement
