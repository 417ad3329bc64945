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

}  // namespace
}  // namespace nacre::measurement
