// Layouts of testing machines' exports that were once read wrongly, and others of their kinds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "layouts.hpp"
#include "measurement/consistency.hpp"
#include "measurement/import.hpp"
#include "measurement/provenance.hpp"
#include "measurement/read_set.hpp"
#include "measurement/tester_export.hpp"
#include "measurement/write_import.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const fs::path kCases = fs::path(NACRE_SOURCE_DIR) / "tests/unit/measurement/data/exports";
Import import_case(const std::string& folder) { return import_exports({}, kCases / folder / "sheet.csv"); }

void expect_usual(const ImportedSpecimen& one, double rate_per_s = kLayoutRatePerS) {
  EXPECT_NEAR(one.test.modulus_pa, kLayoutModulusPa, 0.005 * kLayoutModulusPa) << one.record.specimen;
  EXPECT_NEAR(one.test.toughness_pa, kLayoutToughnessPa, 0.005 * kLayoutToughnessPa) << one.record.specimen;
  EXPECT_TRUE(one.record.valid) << one.record.note;
  if (rate_per_s > 0.0) {
    EXPECT_NEAR(one.record.conditions.strain_rate_per_s, rate_per_s, 0.005 * rate_per_s) << one.record.specimen;
  }
}

void expect_all_usual(const Import& import, std::size_t count) {
  EXPECT_EQ(import.specimens.size(), count) << all_of(import);
  for (const ImportedSpecimen& one : import.specimens) expect_usual(one);
}

TEST(Exports, ASetPointIsNeverTheMeasurement) {
  const Import import = import_case("01-command-column");
  expect_all_usual(import, 1);
  EXPECT_THAT(all_of(import), HasSubstr("`Axial Displacement` taken, not `Axial Displacement Command` (a set point)"));
}

TEST(Exports, AnExactHeadingWins) {
  const Import import = import_case("02-exact-heading-cannot-be-chosen");
  expect_all_usual(import, 1);
  EXPECT_NEAR(import.specimens.at(0).test.peak_stress_pa, 12e6, 0.06e6);
}

TEST(Exports, JumpsByPowersOfTenAreRefused) {
  const Import import = import_case("03-decimal-point-lost-by-spreadsheet");
  EXPECT_TRUE(import.specimens.empty());
  EXPECT_THAT(all_of(import), HasSubstr("by a power of ten from one row to the next"));
}

TEST(Exports, TheRateIsThatOfThePullAfterAHold) {
  const Import import = import_case("06-hold-before-the-pull");
  expect_all_usual(import, 1);
  EXPECT_THAT(all_of(import), HasSubstr("rows before the pull left out (the extension stands still)"));
}

TEST(Exports, TheClockIsKnownInGerman) { expect_all_usual(import_case("07-clock-not-known"), 1); }

TEST(Exports, SpecimensBelowEachOtherAreParts) {
  const Import import = import_case("08-specimens-below-each-other");
  EXPECT_TRUE(import.specimens.empty());
  EXPECT_THAT(all_of(import),
              HasSubstr("holds 3 tests, expected the name or number of one in the column `part`: 1, 2, 3"));
}

TEST(Exports, NoiseOfTheExtensionDoesNotRaiseTheModulus) {
  const Import import = import_case("10-noisy-extension-raises-E");
  ASSERT_EQ(import.specimens.size(), 1U) << all_of(import);
  EXPECT_NEAR(import.specimens[0].test.modulus_pa, kLayoutModulusPa, 0.015 * kLayoutModulusPa);
  EXPECT_GT(import.specimens[0].test.modulus_error_pa, 0.0);
}

TEST(Exports, ACalibratedColumnComesBeforeRawCounts) {
  const Import import = import_case("11-raw-counts-before-newtons");
  expect_all_usual(import, 1);
  EXPECT_THAT(all_of(import), HasSubstr("force: `force_N` taken, not `force_raw` (not calibrated)"));
}

TEST(Exports, AUnitInsideTheHeadingIsRead) { expect_all_usual(import_case("12-unit-inside-the-heading"), 1); }
TEST(Exports, UnitsAboveTheNamesAreRead) { expect_all_usual(import_case("14-units-above-the-names"), 1); }
TEST(Exports, OfTwoClocksTheOneThatGoesOnIsTaken) { expect_all_usual(import_case("16-wavematrix-two-clocks"), 1); }
TEST(Exports, ATimeOfDayIsAClock) { expect_all_usual(import_case("17-clock-time"), 1); }
TEST(Exports, ExtremeValuesAreNoPartOfTheCurve) { expect_all_usual(import_case("18-mts-extreme-values-block"), 3); }

TEST(Exports, SpecimensBesideEachOtherAreParts) {
  const Import import = import_case("20-specimens-side-by-side");
  ASSERT_EQ(import.specimens.size(), 3U) << all_of(import);
  EXPECT_NEAR(import.specimens[0].test.modulus_pa, 1.2e9, 6e6);
  EXPECT_NEAR(import.specimens[1].test.modulus_pa, 1.32e9, 6e6);
  EXPECT_NEAR(import.specimens[2].test.modulus_pa, 1.08e9, 6e6);
}

TEST(Exports, ShiftJisAndGbkAreRead) { expect_all_usual(import_case("21-shift-jis-gbk"), 2); }
TEST(Exports, UnitsMayBeSpeltOut) { expect_all_usual(import_case("22-units-spelt-out"), 4); }

TEST(Exports, ADeadChannelIsPassedOverAndACounterThatRunsDownIsRefused) {
  const Import import = import_case("24-first-load-cell-is-dead");
  ASSERT_EQ(import.specimens.size(), 1U) << all_of(import);
  expect_usual(import.specimens[0]);
  EXPECT_THAT(all_of(import), AllOf(HasSubstr("`Load 1 (N)` does not move and is left out, `Load 2 (N)` is taken"),
                                    HasSubstr("while the force rises: the position counts downwards")));
}

TEST(Exports, ThousandsMayBeGroupedByTypographicSigns) {
  const Import import = import_case("28-numbers-as-programs-group-them");
  EXPECT_EQ(import.specimens.size(), 2U) << all_of(import);
  for (const ImportedSpecimen& one : import.specimens)
    EXPECT_NEAR(one.test.toughness_pa, kLayoutToughnessPa, 0.01 * kLayoutToughnessPa);
}

TEST(Exports, HeadingsOnEveryPageAreOneRecord) { expect_all_usual(import_case("29-headings-on-every-page"), 1); }

TEST(Exports, StrainInPerCentIsDoubted) {
  const MeasurementSet set = read_measurement_set(kCases / "27-strain-in-per-cent/set");
  std::string all;
  for (const std::string& warning : set.warnings) all += warning + "\n";
  EXPECT_THAT(all, HasSubstr("is strain in per cent, not a ratio? Then it would be 2.4"));
}

TEST(Exports, AGroupWithoutAValidSpecimenHasNoMeanAndASingleOneNoScatter) {
  const auto groups = review_replicates(read_measurement_set(kCases / "31-no-valid-specimen-is-a-zero/set").specimens);
  ASSERT_EQ(groups.size(), 2U);
  const auto& none = groups[0].valid.empty() ? groups[0] : groups[1];
  const auto& single = groups[0].valid.empty() ? groups[1] : groups[0];
  EXPECT_FALSE(none.mean_pa || none.scatter);
  EXPECT_EQ(single.mean_pa, 5e4);
  EXPECT_FALSE(single.scatter);
}

TEST_F(Layouts, OfMakersAreReadInTheirLanguages) {
  const std::string semicolons = "{:.3f};{:.5f};{:.4f}\n", tabs = "{:.3f}\t{:.5f}\t{:.4f}\n";
  for (const char* heading :
       {"Time (s),Tensile extension (mm),Load (N)\n", "Time,Crosshead,Load\nsec,mm,N\n",
        "Temps (s),D\xC3\xA9placement (mm),Force (N)\n", "Tiempo (s),Desplazamiento (mm),Fuerza (N)\n",
        "Tempo (s),Spostamento (mm),Forza (N)\n", "Tempo [sec],Corsa [mm],Carico [newton]\n",
        "時間(s),変位(mm),荷重(N)\n", "時間【s】,ストローク【mm】,試験力【N】\n", "时间（秒）,位移（毫米）,力（牛）\n",
        "时间/s,变形/mm,负荷/N\n", "t [s],s [mm],F [N]\n", "t/s,x/mm,F/N\n",
        "Elapsed Time in s,Position in mm,Load Cell in N\n", "Time (s) CH1,Position (mm) CH1,Force (N) CH1\n",
        "\"Time  sec\",\"Extension  mm\",\"Load  N\"\n"})
    expect_read(table(heading));
  for (const char* heading :
       {"Prüfzeit;Standardweg;Standardkraft\ns;mm;N\n", "Laufzeit;Ch 1 Weg;Ch 1 Kraft\ns;mm;N\n",
        "Versuchszeit [s];Traversenweg [mm];Prüfkraft [N]\n", "Zeit in Sekunden;Weg in Millimeter;Kraft in Newton\n",
        "Dauer [s];Verlängerung [mm];Zugkraft [N]\n", "s;mm;N\nZeit;Weg;Kraft\n",
        "Temps écoulé (secondes);Course (millimètres);Effort (newtons)\n"})
    expect_read(with_commas(table(heading, semicolons)));
  expect_read(table("Running Time\tAxial Displacement\tAxial Force\nSec\tmm\tkN\n", tabs, 1.0, 1e-3));
  expect_read(
      table("Time\tExtension\tLoad\n(s)\t(in)\t(lbf)\n", "{:.3f}\t{:.7f}\t{:.6f}\n", 1 / 25.4, 1 / 4.4482216152605));
  expect_read(table("Time (s)|Displacement (m)|Force (kN)\n", "{:.3f}|{:.8f}|{:.7f}\n", 1e-3, 1e-3));
}

// As public scripts describe them: CellScale, MTI, Mecmesin, Trapezium X, TestSuite's timed acquisition, a fatigue
// bench.
TEST_F(Layouts, OfFurtherMakersAreRead) {
  expect_read(table("SetName\tCycle\tTime_S\tSize_mm\tDisplacement_mm\tForce_N\n",
                    "pull\t1-Stretch\t{0:.3f}\t54\t{1:.5f}\t{2:.4f}\n"));
  expect_read(
      table("6/11/2018 11:47:32 AM\nOperator: N. N.\n\nTime,Load,Disp\nsec,N,mm\n", "{0:.3f},{2:.4f},{1:.5f}\n"));
  expect_read(table("Reading,Time (s),Load (N),Displacement (mm)\n", "1,{0:.3f},{2:.4f},{1:.5f}\n"));
  expect_read(table("\"1 _ 1\",\"\",\"\"\n\"Time\",\"Force\",\"Stroke\"\n\"sec\",\"N\",\"mm\"\n",
                    "\"{0:.3f}\",\"{2:.4f}\",\"{1:.5f}\"\n"));
  expect_read(table("Test Run Name,t7\n\nDAQ- Crosshead\n\nCrosshead ,Load ,Time \nmm,kN,sec\n",
                    "{1:.5f},{2:.7f},{0:.3f}\n", 1.0, 1e-3));
  expect_read(table("Machine_N_cycles,Machine_Time (sec),Machine_Load (kN),Machine_Displacement (mm)\n",
                    "0,{0:.3f},{2:.7f},{1:.5f}\n", 1.0, 1e-3));
  expect_read(table("Time in s\tChange in length in mm\tStandard force in N\n", "{0:.3f}\t{1:.5f}\t{2:.4f}\n"));
  expect_read(table("sep=;\nElapsed Time [s];Grip Separation [mm];Axial Load [N];Temperature [C]\n",
                    "{0:.3f};{1:.5f};{2:.4f};21\n"));
}

TEST_F(Layouts, WithSetPointsLateralAndRawColumnsGiveTheMeasurement) {
  const std::string twice = "{0:.3f},{3:.5f},{1:.5f},{4:.4f},{2:.4f}\n";
  for (const char* heading :
       {"Zeit [s],Weg Sollwert [mm],Weg [mm],Sollkraft [N],Kraft [N]\n",
        "Temps (s),Consigne de d\xC3\xA9placement (mm),D\xC3\xA9placement (mm),Consigne effort (N),Effort (N)\n",
        "Time (s),Target Position (mm),Position (mm),Force Setpoint (N),Force (N)\n",
        "Time (s),Position Demand (mm),Position (mm),Load cmd (N),Load (N)\n",
        "Time (s),Lateral Displacement (mm),Axial Displacement (mm),Load ADC (counts),Load (N)\n",
        "Zeit [s],Breiten\xC3\xA4nderung [mm],L\xC3\xA4ngen\xC3\xA4nderung [mm],Kraft roh,Kraft [N]\n",
        "時間(s),目標変位(mm),変位(mm),設定荷重(N),荷重(N)\n",
        "Time (s),Displacement,Displacement (mm),Force,Force (N)\n"}) {
    std::string text = heading;
    for (const Point& each : usual_test())
      text += fmt::format(fmt::runtime(twice), each.time_s, each.extension_mm, each.force_n, 1.5 * each.extension_mm,
                          7.0 + 3.1 * each.force_n);
    expect_read(text);
  }
  const std::string only = table("Time (s),Position Command (mm),Load (N)\n");
  expect_refused(only, "no measured column of extension");
  expect_read(only, ",extension_column", ",Position Command (mm)");
}

TEST_F(Layouts, WithoutUnitsAreRefusedUnlessOnlyOneIsPossibleOrTheSheetNamesThem) {
  const std::string bare = table("Time,Extension,Load\n");
  expect_read(bare);
  EXPECT_THAT(all_of(import(bare)), HasSubstr("mm and N is assumed"));
  const std::string kilonewtons = table("Time (s),Extension (mm),Load\n", "{:.3f},{:.5f},{:.7f}\n", 1.0, 1e-3);
  expect_read(kilonewtons);
  EXPECT_THAT(all_of(import(kilonewtons)), HasSubstr("kN is assumed"));
  expect_read(kilonewtons, ",unit", ",kN");
  const std::string stones = table("Time (s),Extension (mm),Load (stone)\n");
  expect_refused(stones, "`(stone)` is not a unit of force");
}

TEST_F(Layouts, OfSeveralSpecimensAreOfferedAsPartsByName) {
  const auto lines = [](const std::string& title, double scale, const std::string& heading) {
    std::string text = title + heading;
    for (const Point& each : usual_test(scale))
      text += fmt::format("{:.3f};{:.5f};{:.4f}\n", each.time_s, each.extension_mm, each.force_n);
    return text + "\n";
  };
  const std::string heading = "Time [s];Travel [mm];Force [N]\n";
  const std::string below = lines("Specimen A\n", 1.1, heading) + lines("Specimen B\n", 1.0, heading);
  expect_refused(below,
                 "holds 2 tests, expected the name or number of one in the column `part`: Specimen A, Specimen B");
  expect_read(below, ",part", ",Specimen B");
  expect_read(below, ",part", ",2");
  const std::string once = lines("", 1.1, heading) + lines("Probe 2\n", 1.0, "");
  expect_refused(once, "holds 2 tests");
  expect_read(once, ",part", ",2");
  expect_refused(lines("", 1.1, heading) + lines("", 1.0, ""), "holds 2 tests");
  std::string beside =
      "Time (s) Run #1,Position (mm) Run #1,Force (N) Run #1,Time (s) Run #2,Position (mm) Run #2,Force (N) Run #2\n";
  for (const Point& each : usual_test())
    beside += fmt::format("{0:.3f},{1:.5f},{3:.4f},{0:.3f},{1:.5f},{2:.4f}\n", each.time_s, each.extension_mm,
                          each.force_n, 1.1 * each.force_n);
  expect_refused(beside, "holds 2 tests");
  expect_read(beside, ",part", ",run #2");
  expect_read(beside, ",part", ",2");
  std::string labelled = "Probe;Zeit [s];Weg [mm];Kraft [N]\n";
  for (const char* name : {"P7", "P9"}) {
    for (const Point& each : usual_test(name[1] == '7' ? 1.1 : 1.0))
      labelled += fmt::format("{};{:.3f};{:.5f};{:.4f}\n", name, each.time_s, each.extension_mm, each.force_n);
  }
  expect_refused(labelled, "P7, P9");
  expect_read(labelled, ",part", ",P9");
}

TEST_F(Layouts, OfTablesOfResultsBeforeAndBehindLeaveTheCurve) {
  const std::string results =
      "Results\nSpecimen,Load (N),Extension (mm),Modulus (MPa)\n1,1996.8,0.54,1200\nMean,1996.8,0.54,1200\n\n";
  const std::string curve = table("Time (s),Extension (mm),Load (N)\n");
  expect_read(results + curve);
  expect_read(curve + "\n" + results);
  expect_read("Speed,1.2 mm/min\nPreload,1,N\n\n" + curve +
              "\nMaximum Load (N),Extension at Break (mm)\n1996.8,1.08\n");
}

TEST_F(Layouts, OfNumbersInEveryLocaleAreRead) {
  expect_read(table("Time (s),Extension (mm),Load (N)\n", "{:.4E},{:.5E},{:.6E}\n"));
  expect_read(with_commas(table("Zeit [s];Weg [mm];Kraft [N]\n", "{:.5e};{:.6e};{:.6e}\n")));
  std::string grouped = "Time (s)\tExtension (mm)\tLoad (mN)\n";
  for (const Point& each : usual_test()) {
    const long long force = std::llround(1e3 * each.force_n);
    const std::string text = force < 1000 ? fmt::format("{}", force)
                             : force < 1000000
                                 ? fmt::format("{},{:03}", force / 1000, force % 1000)
                                 : fmt::format("{},{:03},{:03}", force / 1000000, force / 1000 % 1000, force % 1000);
    grouped += fmt::format("{:.3f}\t{:.5f}\t{}\n", each.time_s, each.extension_mm, text);
  }
  expect_read(grouped);
}

TEST_F(Layouts, OfHoldsAndTaresGiveThePull) {
  std::string hold = "Time (s),Extension (mm),Load (N)\n", tare = hold;
  for (int i = 0; i < 200; ++i) {
    hold += fmt::format("{:.2f},2.5000,0.0000\n", 0.54 * i);
    tare += fmt::format("{:.2f},3.2000,0.0000\n", 0.54 * i);
  }
  for (const Point& each : usual_test()) {
    hold += fmt::format("{:.3f},{:.5f},{:.4f}\n", 108 + each.time_s, 2.5 + each.extension_mm, each.force_n);
    tare += fmt::format("{:.3f},{:.5f},{:.4f}\n", 108 + each.time_s, each.extension_mm, each.force_n);
  }
  expect_read(hold);
  expect_read(tare);
}

TEST_F(Layouts, ThatCannotBeTrustedAreRefusedByName) {
  expect_refused(table("Time (s),Extension (mm),Load (N)\n", "{0:.3f},1.00000,{2:.4f}\n"),
                 "the extension does not move");
  expect_refused(table("Time (s),Extension (mm),Load (N)\n", "{0:.3f},{1:.5f},0.5\n"), "the force does not move");
  expect_refused(table("Time (s),Position (mm),Load (N)\n", "{0:.3f},{1:.5f},{2:.4f}\n", -1.0), "counts downwards");
}

TEST_F(Layouts, OfAClockThatCannotBeReadAreReadWithoutIt) {
  const std::string text = table("Time,Extension (mm),Load (N)\n", "n/a,{1:.5f},{2:.4f}\n");
  const Import import = this->import(text);
  ASSERT_EQ(import.specimens.size(), 1U) << all_of(import);
  EXPECT_THAT(all_of(import), HasSubstr("the clock is not used"));
  EXPECT_EQ(import.specimens[0].rate_source, "default");
}

TEST_F(Layouts, OfStrainAndStressAreReadWhereTheSheetNamesThem) {
  std::string text = "Time (s),Tensile strain (%),Tensile stress (MPa)\n";
  for (const Point& each : usual_test())
    text += fmt::format("{:.3f},{:.6f},{:.6f}\n", each.time_s, 100 * each.extension_mm / 54, each.force_n / 52 / 3.2);
  expect_read(text, ",strain_column,stress_column", ",Tensile strain (%),Tensile stress (MPa)");
  EXPECT_TRUE(import(text).specimens.empty());
}

TEST_F(Layouts, TheSetKeepsWhereItsNumbersCameFrom) {
  Import first = import(table("Time (s),Extension (mm),Stroke (mm),Load (N)\n", "{0:.3f},{1:.5f},{1:.5f},{2:.4f}\n"));
  write_import(folder_ / "set", "sheet.csv", first);
  std::ifstream file(folder_ / "set" / kProvenanceName);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text,
              AllOf(HasSubstr("specimen,test,file,part,maker"), HasSubstr("s1,toughness,a.csv,1,table,UTF-8,comma"),
                    HasSubstr("Extension (mm),mm,Stroke (mm)")));
}

}  // namespace
}  // namespace nacre::measurement
