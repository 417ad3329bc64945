// Which of several columns is the measurement, where the words beside a quantity's name are any.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "layouts.hpp"

namespace nacre::measurement {
namespace {

using testing::HasSubstr;

class ColumnChoices : public Layouts {
 protected:
  /// Rows of time, a false extension, the extension, a false force, the force.
  static std::string with_false_twins(const std::string& heading, double extension = 1.5, double force = 3.1) {
    std::string text = heading + "\n";
    for (const Point& each : usual_test())
      text += fmt::format("{:.3f};{:.5f};{:.5f};{:.4f};{:.4f}\n", each.time_s, extension * each.extension_mm,
                          each.extension_mm, 7.0 + force * each.force_n, each.force_n);
    return text;
  }
  /// Rows of time, a false column, extension, force.
  static std::string after_false_column(const std::string& heading, double of_extension, double of_force) {
    std::string text = heading + "\n";
    for (const Point& each : usual_test())
      text += fmt::format("{:.3f},{:.6f},{:.5f},{:.4f}\n", each.time_s,
                          of_extension * each.extension_mm + of_force * each.force_n, each.extension_mm, each.force_n);
    return text;
  }
};

TEST_F(ColumnChoices, SetPointsInAnyWordsAreNeverTheMeasurement) {
  for (const char* heading :
       {"Zeit [s];Weg (Vorgabe) [mm];Weg [mm];Kraft nominal [N];Kraft [N]",
        "Zeit [s];Lagesollwert [mm];Lageistwert [mm];Kraftsollwert [N];Kraftistwert [N]",
        "Zeit [s];Ziel-Weg [mm];Weg [mm];Zielkraft [N];Kraft [N]",
        "Zeit [s];Weg SW [mm];Weg IW [mm];Soll [N];Kraft [N]",
        "Time (s);Requested Position (mm);Position (mm);Requested Load (N);Load (N)",
        "Time (s);Planned Displacement (mm);Displacement (mm);Expected Force (N);Force (N)",
        "Time (s);Position Profile (mm);Position (mm);Load Generator (N);Load (N)",
        "Time (s);Position (cmd) (mm);Position (fbk) (mm);Load SP (N);Load PV (N)",
        "Temps (s);Déplacement demandé (mm);Déplacement mesuré (mm);Force théorique (N);Force mesurée (N)",
        "Tiempo (s);Desplazamiento deseado (mm);Desplazamiento real (mm);Fuerza programada (N);Fuerza real (N)",
        "Tempo (s);Spostamento comandato (mm);Spostamento (mm);Forza impostata (N);Forza (N)",
        "时间(s);命令位移(mm);反馈位移(mm);试验力目标值(N);试验力(N)",
        "時間(s);変位目標値(mm);変位(mm);荷重指令値(N);荷重(N)"})
    expect_read(with_false_twins(heading));
}

TEST_F(ColumnChoices, ThePlainNameComesBeforeOneThatAnyWordQualifies) {
  for (const char* heading :
       {"Time (s),Friction force (N),Extension (mm),Force (N)", "Time (s),Grip force (N),Extension (mm),Force (N)",
        "Time (s),Klemmkraft (N),Weg (mm),Kraft (N)", "Time (s),Load offset (N),Weg (mm),Kraft (N)",
        "Time (s),Previous load (N),Extension (mm),Load (N)", "Time (s),Load left (N),Extension (mm),Load (N)",
        "Time (s),Load per width (N/mm),Extension (mm),Load (N)", "Time (s),Tension (MPa),Extension (mm),Load (N)"})
    expect_read(after_false_column(heading, 0.0, 0.6));
  for (const char* heading :
       {"Time (s),Crack opening displacement (mm),Crosshead displacement (mm),Force (N)",
        "Time (s),Compliance corrected extension (mm),Extension (mm),Force (N)",
        "Time (s),Gauge length (mm),Extension (mm),Force (N)", "Time (s),Position error (mm),Position (mm),Force (N)",
        "Time (s),ΔL/L0,ΔL (mm),F (N)", "Time (s),Encoder,Extension (mm),Force (N)"})
    expect_read(after_false_column(heading, 0.4, 0.0));
  const std::string text = after_false_column("Time (s),Grip force (N),Extension (mm),Force (N)", 0.0, 0.6);
  EXPECT_THAT(all_of(import(text)),
              HasSubstr("`Force (N)` taken, not `Grip force (N)` (another word says more of it)"));
}

TEST_F(ColumnChoices, APlaceIsNoQuantity) {
  expect_read(table("Time (s),Actuator Position (mm),Actuator Force (N)\n"));
  expect_read(table("Time (s),Crosshead (mm),Crosshead Load (N)\n"));
}

TEST_F(ColumnChoices, WhatNothingButItsPlaceTellsApartIsAWarning) {
  const std::string two = with_false_twins("Time (s);Spare 1;Extension (mm);Load A (N);Load B (N)");
  const std::string warning = "`Load A (N)` and `Load B (N)` are both measured columns of force and differ";
  EXPECT_THAT(import(two).warnings, testing::Contains(HasSubstr(warning)));
  expect_read(two, ",force_column", ",Load B (N)");
  const std::string alike = with_false_twins("Time (s);Spare 1;Extension (mm);Load A (N);Load B (N)", 1.0, 1.0);
  EXPECT_THAT(import(alike).warnings, testing::Not(testing::Contains(HasSubstr("differ"))));
}

TEST_F(ColumnChoices, ALoadCellAtItsLimitIsPassedOverOrDoubted) {
  std::string two = "Time (s),Load 50N (N),Load 5kN (N),Extension (mm)\n", one = "Time (s),Extension (mm),Load (N)\n";
  for (const Point& each : usual_test()) {
    two += fmt::format("{:.3f},{:.3f},{:.3f},{:.5f}\n", each.time_s, std::min(each.force_n, 50.2), each.force_n,
                       each.extension_mm);
    one += fmt::format("{:.3f},{:.5f},{:.3f}\n", each.time_s, each.extension_mm, std::min(each.force_n, 1500.0));
  }
  expect_read(two);
  EXPECT_THAT(import(one).warnings, testing::Contains(HasSubstr("is the load cell at its limit?")));
}

TEST_F(ColumnChoices, APositionThatCountsDownIsRefusedOrReadWhereTheSheetSaysSo) {
  const auto falling = [](double approach, double travel) {
    std::string text = "Time (s),Position (mm),Load (N)\n";
    const auto usual = usual_test();
    for (int i = 0; i < 60; ++i)
      text += fmt::format("{:.3f},{:.5f},{:.3f}\n", 0.5 * i, 120.0 - approach * (60 - i) / 60.0, 0.2 * (i % 2));
    for (const Point& each : usual)
      text +=
          fmt::format("{:.3f},{:.5f},{:.4f}\n", 30.0 + each.time_s, 120.0 - travel * each.extension_mm, each.force_n);
    return text;
  };
  for (const double approach : {0.0, 10.0, -10.0}) {
    for (const double travel : {1.0, 15.4, 50.0})
      expect_refused(falling(approach, travel), "the position counts downwards");
  }
  expect_read(falling(0.0, 1.0), ",extension_column", ",-Position (mm)");
  EXPECT_THAT(all_of(import(falling(0.0, 1.0), ",extension_column", ",-Position (mm)")),
              HasSubstr("`Position (mm)` counts downwards in tension, as the sheet says"));
}

TEST_F(ColumnChoices, AForceThatIsNotSetToZeroIsDoubted) {
  std::string offset = "Time (s),Extension (mm),Load (N)\n", flipped = offset;
  for (const Point& each : usual_test()) {
    offset += fmt::format("{:.3f},{:.5f},{:.4f}\n", each.time_s, each.extension_mm, each.force_n - 100.0);
    const bool flips = each.time_s > 10.0 && each.time_s < 16.0;
    flipped += fmt::format("{:.3f},{:.5f},{:.4f}\n", each.time_s, each.extension_mm, (flips ? -1 : 1) * each.force_n);
  }
  EXPECT_THAT(import(offset).warnings, testing::Contains(HasSubstr("the force falls to -5 % of its peak before it")));
  EXPECT_THAT(import(flipped).warnings, testing::Contains(HasSubstr("did signs get lost?")));
}

TEST_F(ColumnChoices, AUnitThatMakesNoModulusOfTheMaterialIsDoubted) {
  const std::string kilonewtons = table("Time (s),Extension (mm),Load (N)\n", "{:.3f},{:.5f},{:.7f}\n", 1.0, 1e-3);
  EXPECT_THAT(import(kilonewtons).warnings,
              testing::Contains(HasSubstr("its modulus, 1.2e+06 Pa, is unusual for rigid")));
  EXPECT_THAT(import(table("Time (s),Extension (mm),Load (N)\n")).warnings, testing::IsEmpty());
}

}  // namespace
}  // namespace nacre::measurement
