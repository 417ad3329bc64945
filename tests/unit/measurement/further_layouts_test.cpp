// Layouts of exports beyond one heading above columns of bare numbers: units in the cells, headings over two lines,
// columns of fixed width.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "layouts.hpp"

namespace nacre::measurement {
namespace {

using testing::HasSubstr;

class FurtherLayouts : public Layouts {};

TEST_F(FurtherLayouts, WithUnitsInTheCellsAreRead) {
  expect_read(table("Time,Extension,Load\n", "{:.3f} s,{:.5f} mm,{:.4f} N\n"));
  EXPECT_THAT(all_of(import(table("Time,Extension,Load\n", "{:.3f} s,{:.5f} mm,{:.4f} N\n"))),
              HasSubstr("force: `Load` in N, as its cells say"));
  expect_read(table("Time (s),Position,Load\n", "{:.3f},{:.8f} m,{:.6e}kN\n", 1e-3, 1e-3));
  expect_read(table("Time (s),Extension (mm),Load (kN)\n", "{:.3f} s,{:.5f} mm,{:.7f} kN\n", 1.0, 1e-3));
  expect_read(with_commas(table("Zeit;Weg;Kraft\n", "{:.3f} s;{:.2f} \xC2\xB5m;{:.4f}\xC2\xA0N\n", 1e3)));
  expect_read(with_commas(table("Zeit [s];Weg;Kraft\n", "\"{:.3f}\";\"{:.5f} mm\";\"{:.4f} N\"\n")));
}

TEST_F(FurtherLayouts, WithUnitsThatDifferFromCellToCellAreRefused) {
  std::string ranged = "Time (s),Extension,Load\n", torn = ranged;
  for (const Point& each : usual_test()) {
    const std::string extension = fmt::format("{:.3f},{:.5f} mm", each.time_s, each.extension_mm);
    ranged += each.force_n < 1000 ? fmt::format("{},{:.4f} N\n", extension, each.force_n)
                                  : fmt::format("{},{:.7f} kN\n", extension, 1e-3 * each.force_n);
    torn += fmt::format("{},{:.4f}{}\n", extension, each.force_n, each.force_n > 1000 ? "" : " N");
  }
  expect_refused(ranged, "the cells of the column differ in their unit");
  expect_refused(torn, "the cells of the column differ in their unit");
  expect_refused(table("Time (s),Extension (mm),Load (kN)\n", "{:.3f},{:.5f} mm,{:.4f} N\n"),
                 "the heading is in `kN` and line 2 in `N`, expected one unit");
  expect_refused(table("Time (s),Extension (mm),Load (N)\n", "{:.3f},{:.5f},{:.4f} mm\n"),
                 "the heading is in `N` and line 2 in `mm`");
}

TEST_F(FurtherLayouts, WithHeadingsOverTwoLinesAreRead) {
  const std::string twice = "{0:.3f},{3:.5f},{1:.5f},{4:.4f},{2:.4f}\n";
  const auto with_set_points = [&](const std::string& heading) {
    std::string text = heading;
    for (const Point& each : usual_test())
      text += fmt::format(fmt::runtime(twice), each.time_s, each.extension_mm, each.force_n, 1.5 * each.extension_mm,
                          7.0 + 3.1 * each.force_n);
    return text;
  };
  expect_read(table("Running,Axial,Axial\nTime,Displacement,Force\n(s),(mm),(N)\n"));
  expect_read(table("Elapsed,Cross,Load\nTime (s),head (mm),Cell (N)\n"));
  expect_read(table("Test,Grip,Standard\nTime,Separation,Force\nsec,mm,kN\n", "{:.3f},{:.5f},{:.7f}\n", 1.0, 1e-3));
  expect_read(
      with_commas(table("Pr\xC3\xBC"
                        "f-;Traversen-;Standard-\nzeit;weg;kraft\ns;mm;N\n",
                        "{:.3f};{:.5f};{:.4f}\n")));
  for (const char* heading :
       {"Running,Command,Axial,Command,Axial\nTime,Displacement,Displacement,Force,Force\ns,mm,mm,N,N\n",
        "Zeit,Weg,Weg,Kraft,Kraft\nIst,Soll,Ist,Soll,Ist\ns,mm,mm,N,N\n",
        "Time,Position,,Load,\n,Target,Actual,Target,Actual\nsec,mm,mm,N,N\n",
        ",Command,,Command,\nTime (s),Position (mm),Position (mm),Load (N),Load (N)\n"})
    expect_read(with_set_points(heading));
  const std::string page =
      with_set_points("Running,Command,Axial,Command,Axial\nTime,Displacement,Displacement,Force,Force\ns,mm,mm,N,N\n");
  EXPECT_THAT(all_of(import(page)), HasSubstr("`Axial Displacement` taken, not `Command Displacement` (a set point)"));
}

TEST_F(FurtherLayouts, OfFixedWidthAreRead) {
  expect_read(table("  Time (s)   Extension (mm)   Load (N)\n", "{:10.3f}   {:14.5f}   {:8.4f}\n"));
  expect_read(table("Operator: N. N.\nSpeed  1.2 mm/min\n\nTime  Stroke  Force\n sec      mm     N\n",
                    "{:.3f}  {:.5f}  {:.4f}\n"));
  expect_read(with_commas(
      table("Zeit      Weg        Kraft\n[s]       [mm]       [kN]\n", "{:<8.3f}  {:<9.5f}  {:.7f}\n", 1.0, 1e-3)));
  expect_read(table("Elapsed      Cross      Load\nTime         head       Cell\nsec          mm         N\n",
                    "{:<11.3f}  {:<9.5f}  {:.4f}\n"));
}

TEST_F(FurtherLayouts, OfFixedWidthWithAnEmptyCellAreRefused) {
  std::string text = "Time (s)   Position (mm)   Extension (mm)   Load (N)\n";
  for (const Point& each : usual_test())
    text +=
        fmt::format("{:8.3f}   {:13}   {:14.5f}   {:8.4f}\n", each.time_s,
                    each.time_s > 30 ? "" : fmt::format("{:.5f}", each.extension_mm), each.extension_mm, each.force_n);
  expect_refused(text, "has 3 columns, expected 4 as in the heading");
  std::string narrow = "Time (s)  Extension (mm)  Load (N)\n";
  for (const Point& each : usual_test())
    narrow += fmt::format("{:.0f} {:03.0f}  {:.4f}\n", each.time_s, 100 * each.extension_mm, each.force_n);
  expect_refused(narrow, "the row has 2 cells, expected 3");
}

TEST_F(FurtherLayouts, WithFactorsInTheirUnitsAreReadOrRefused) {
  expect_read(table("Time (s),Displacement [10^-3 mm],Force [10 N]\n", "{:.3f},{:.4f},{:.6f}\n", 1e3, 0.1));
  expect_read(table("Time (s),Displacement [1/100 mm],Force in 10 N\n", "{:.3f},{:.4f},{:.6f}\n", 100, 0.1));
  expect_read(table("Time (s),Displacement 1/100 mm,Force (dN)\n", "{:.3f},{:.4f},{:.6f}\n", 100, 10));
  expect_refused(table("Time (s),Displacement [x1000 mm],Force (N)\n"), "`[x1000 mm]` is not a unit of extension");
  expect_refused(table("Time (s),Displacement (mm),Force [x 10 N]\n"), "`[x 10 N]` is not a unit of force");
  expect_refused(table("Time (s),Extension (mm),Load (N)\ns,mm,kN\n"),
                 "`N` in the heading, `kN` in the row of units, expected one unit");
}

TEST_F(FurtherLayouts, OfStatisticsBetweenTheirRowsLeaveTheCurve) {
  const std::string curve = table("Time [s];Travel [mm];Force [N]\n", "{:.3f};{:.5f};{:.4f}\n");
  expect_read(curve + "Mean;0.54;998\nMax;64.8;1996.8\n");
  expect_read(curve + "\nStatistics\nMean;0.54;1996.8\nSD;0.01;12.0\nMin;0.53;1990\nMax;0.55;2003\nCV;1;1\n");
  expect_read("Time [s];Travel [mm];Force [N]\nMax;1.296;1996.8\nMin;0;0\n" + table("", "{:.3f};{:.5f};{:.4f}\n"));
}

TEST_F(FurtherLayouts, OfSingleBlanksAndLineBreaksInHeadingsAreRead) {
  expect_read(table("# Time(s) Extension(mm) Load(N)\n", "{:.10e} {:.10e} {:.10e}\n"));
  expect_read(table("Time (s) Position (mm) Load (N)\n", "{:.3f} {:.5f} {:.4f}\n"));
  expect_read(table("\"Time\n(s)\",\"Extension\n(mm)\",\"Load\n(N)\"\n"));
}

TEST_F(FurtherLayouts, BesideEachOtherAreKnownByTheirOrder) {
  const auto beside = [](const std::string& heading) {
    std::string text = heading;
    for (const Point& each : usual_test())
      text += fmt::format("{0:.3f};{1:.5f};{3:.7f};{0:.3f};{1:.5f};{2:.4f}\n", each.time_s, each.extension_mm,
                          each.force_n, 1.1e-3 * each.force_n);
    return text;
  };
  for (const char* heading : {"A;;;B;;\nTime;Travel;Force;Time;Travel;Force\ns;mm;kN;s;mm;N\n",
                              "Time [s];Travel [mm];Force [kN];Time [s].1;Travel [mm].1;Force [N].1\n",
                              "Probe1_Zeit [s];Probe1_Weg [mm];Probe1_Kraft [kN];Probe2_Zeit [s];Probe2_Weg "
                              "[mm];Probe2_Kraft [N]\n"}) {
    expect_refused(beside(heading), "holds 2 tests");
    expect_read(beside(heading), ",part", ",2");
  }
}

TEST_F(FurtherLayouts, OfSpecimensOnOneExtensionAreParts) {
  std::string text = "Zeit [s];Weg [mm];Probe 1 Kraft [N];Probe 2 Kraft [N]\n";
  for (const Point& each : usual_test()) {
    const bool is_over = each.extension_mm > 1.1;
    text += fmt::format("{:.3f};{:.5f};{};{:.4f}\n", each.time_s, each.extension_mm,
                        is_over ? "" : fmt::format("{:.4f}", 1.1 * each.force_n), each.force_n);
  }
  expect_refused(text, "holds 2 tests");
  expect_read(text, ",part", ",Probe 2");
  EXPECT_EQ(import(text, ",part", ",Probe 1").specimens.size(), 1U) << all_of(import(text, ",part", ",Probe 1"));
}

TEST_F(FurtherLayouts, WithMarksThatMayGroupThousandsAreReadAsDecimalsWithAWarning) {
  std::string text = "Time [s];Position [mm];Force [N]\n";
  for (int i = 0; i <= 120; ++i)
    text += fmt::format("{};{:.3f};{:.0f}\n", i, 100.0 + 0.01 * i, i <= 60 ? 33.28 * i : 33.28 * (120 - i));
  const Import import = this->import(text);
  ASSERT_EQ(import.specimens.size(), 1U) << all_of(import);
  EXPECT_NEAR(import.specimens[0].test.failure_strain, 1.2 / 54, 2e-4);
  EXPECT_THAT(import.warnings, testing::Contains(HasSubstr("it is read as the decimal mark")));
}

TEST_F(FurtherLayouts, OfDatesAndZonesAreClocks) {
  for (const char* format :
       {"2026-03-12T10:0{}:{:06.3f}Z", "2026-03-12 10:0{}:{:06.3f}+01:00", "12.03.2026 10:0{}:{:06.3f}"}) {
    std::string text = "Date/Time;Extension (mm);Load (N)\n";
    for (const Point& each : usual_test()) {
      const int minutes = static_cast<int>(each.time_s) / 60;
      text += fmt::format(fmt::runtime(format), minutes, each.time_s - 60.0 * minutes) +
              fmt::format(";{:.5f};{:.4f}\n", each.extension_mm, each.force_n);
    }
    expect_read(text);
  }
  const Import without = import(table("Point,Extension (mm),Load (N)\n"));
  EXPECT_THAT(without.warnings,
              testing::Contains(HasSubstr("no clock is read; the strain rate 0.000617 1/s is assumed")));
}

}  // namespace
}  // namespace nacre::measurement
