#include "measurement/import.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "measurement/read_set.hpp"
#include "measurement/write_import.hpp"
#include "measurement/write_set.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const fs::path kExports = fs::path(NACRE_SOURCE_DIR) / "tests/unit/measurement/data/exports";

std::map<std::string, ImportedSpecimen> by_name(const Import& import) {
  std::map<std::string, ImportedSpecimen> specimens;
  for (const ImportedSpecimen& one : import.specimens) specimens.emplace(one.record.specimen, one);
  return specimens;
}

TEST(Import, TheSameTestGivesTheSameNumbersWhateverTheMachineWrites) {
  const Import import = import_exports({}, kExports / "clean/specimens.csv");
  for (const ImportFault& fault : import.rejected) ADD_FAILURE() << to_string(fault);
  ASSERT_EQ(import.specimens.size(), 17U);
  for (const ImportedSpecimen& one : import.specimens) {
    SCOPED_TRACE(one.record.specimen);
    EXPECT_NEAR(one.test.modulus_pa, 800e6, 4e6);
    EXPECT_NEAR(one.test.toe_strain, 0.001, 2e-5);
    EXPECT_NEAR(one.test.peak_stress_pa, 6e6, 5e4);
    EXPECT_NEAR(one.test.failure_strain, 0.03 - 0.02 * 6.0 / 3.0 * 0.018, 2e-4);
    const bool cycled = one.record.specimen == "cycles";
    EXPECT_NEAR(*one.record.toughness_pa, 0.072e6, 0.0004e6);
    EXPECT_TRUE(one.record.valid);
    EXPECT_NEAR(one.record.conditions.strain_rate_per_s, 2.0 / 60 / 54, cycled ? 2e-4 : 2e-6);
    EXPECT_EQ(one.record.batch, "march");
    EXPECT_EQ(one.record.other_columns.at("path"), "straight");
    EXPECT_FALSE(one.record.modulus_pa) << "a notched specimen does not determine the modulus";
  }
}

TEST(Import, MakersAndHeadersAreRecognised) {
  const auto specimens = by_name(import_exports({}, kExports / "clean/specimens.csv"));
  EXPECT_EQ(specimens.at("bluehill2_raw").maker, "Instron Bluehill");
  EXPECT_EQ(specimens.at("bluehill_universal_results").maker, "Instron Bluehill");
  EXPECT_EQ(specimens.at("testxpert2_de").maker, "ZwickRoell testXpert");
  EXPECT_EQ(specimens.at("testxpert3_en").maker, "ZwickRoell testXpert");
  EXPECT_EQ(specimens.at("mts793_blocks").maker, "MTS");
  EXPECT_EQ(specimens.at("plain").maker, "table");
  const auto& bluehill = specimens.at("bluehill_universal_results").record.other_columns;
  EXPECT_EQ(bluehill.at("operator"), "A. Lovelace");
  EXPECT_EQ(bluehill.at("date"), "2026-03-12 10:21:07");
  EXPECT_EQ(bluehill.at("machine"), "Instron 5984");
  const auto& zwick = specimens.at("testxpert2_de").record.other_columns;
  EXPECT_EQ(zwick.at("operator"), "K. Zuse");
  EXPECT_EQ(zwick.at("date"), "12.03.2026");
  EXPECT_EQ(specimens.at("mts_testsuite").record.other_columns.at("operator"), "G. Hopper");
}

TEST(Import, UnloadingLoopsAreKeptAndAnElasticLoopCostsNoEnergy) {
  const auto specimens = by_name(import_exports({}, kExports / "clean/specimens.csv"));
  const ImportedSpecimen &plain = specimens.at("plain"), &cycled = specimens.at("cycles");
  int unloading = 0;
  for (std::size_t i = 1; i < cycled.test.curve.size(); ++i)
    unloading += cycled.test.curve.strain[i] < cycled.test.curve.strain[i - 1];
  EXPECT_EQ(unloading, 20);
  EXPECT_NEAR(*cycled.record.toughness_pa, *plain.record.toughness_pa, 1e-3 * *plain.record.toughness_pa);
}

TEST(Import, EveryDamagedFileGivesOneErrorAndLosesNoOtherSpecimen) {
  const Import import = import_exports({}, kExports / "damaged/specimens.csv");
  const std::map<std::string, std::pair<int, std::string>> expected = {
      {"compression.csv", {2, "tension counts as positive: the force is negative"}},
      {"cut_off.csv", {134, "expected 3"}},
      {"cut_utf16.csv", {0, "half a character"}},
      {"empty.csv", {0, "is empty, expected a table"}},
      {"heading_only.csv", {1, "no numbers below the heading"}},
      {"letter.txt", {0, "no heading with extension and force, expected names such as"}},
      {"mixed_decimals.csv", {61, "decimal commas in one file"}},
      {"no_extension.csv", {1, "no column of extension"}},
      {"no_force.csv", {1, "no column of force"}},
      {"overload.csv", {41, "`****` is not a number"}},
      {"text_in_number.csv", {41, "`####` is not a number"}},
      {"three_rows.csv", {2, "expected at least 5"}},
      {"time_back.csv", {51, "time goes back"}},
      {"unknown_unit.csv", {2, "`(stone)` is not a unit of force, expected one of N, kN"}},
      {"workbook.csv", {0, "is a workbook, expected a text file"}},
      {"zero_bytes.csv", {0, "zero bytes"}},
  };
  std::map<std::string, int> seen;
  for (const ImportFault& fault : import.rejected) {
    const std::string name = fs::path(fault.file).filename().string();
    ++seen[name];
    const auto known = expected.find(name);
    if (known == expected.end()) continue;
    EXPECT_EQ(fault.line, known->second.first) << to_string(fault);
    EXPECT_THAT(fault.reason, HasSubstr(known->second.second)) << to_string(fault);
  }
  for (const auto& [name, fault] : expected) EXPECT_EQ(seen[name], 1) << name;
  EXPECT_EQ(seen["specimens.csv"], 6) << "faults of the sheet itself";
  const auto specimens = by_name(import);
  ASSERT_EQ(specimens.size(), 2U);
  EXPECT_TRUE(specimens.at("whole").record.valid);
}

TEST(Import, ARecordThatStopsBeforeSeparationIsKeptAsNotValid) {
  const auto specimens = by_name(import_exports({}, kExports / "damaged/specimens.csv"));
  const ImportedSpecimen& stopped = specimens.at("stopped");
  EXPECT_FALSE(stopped.record.valid);
  EXPECT_THAT(stopped.record.note, HasSubstr("not separated"));
  EXPECT_FALSE(stopped.test.separated);
}

TEST(Import, FaultsOfTheSheetNameLineColumnAndWhatWasExpected) {
  const Import import = import_exports({}, kExports / "damaged/specimens.csv");
  std::map<std::string, std::string> by_column;
  for (const ImportFault& fault : import.rejected) {
    if (fs::path(fault.file).filename() == "specimens.csv") by_column[fault.column] += to_string(fault) + "\n";
  }
  EXPECT_THAT(by_column["width_mm"], HasSubstr("expected a length in mm"));
  EXPECT_THAT(by_column["test"], HasSubstr("expected modulus, toughness or tensile"));
  EXPECT_THAT(by_column["pattern"], HasSubstr("577fffe9fffde"));
  EXPECT_THAT(by_column["part"], HasSubstr("holds 2 tests"));
  EXPECT_THAT(by_column["specimen"], HasSubstr("occurs twice"));
  EXPECT_THAT(by_column["file"], HasSubstr("absent.csv"));
}

class ImportedSet : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-import-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  Import import(const std::string& sheet, const ImportSettings& settings = {}) const {
    write("sheet.csv", sheet);
    return import_exports({}, folder_ / "sheet.csv", settings);
  }
  /// A record of `extension_mm` and `force_n` at one point a second.
  static std::string table(const std::vector<std::pair<double, double>>& points, const std::string& heading) {
    std::string text = heading + "\n";
    for (std::size_t i = 0; i < points.size(); ++i)
      text += std::to_string(i) + "," + std::to_string(points[i].first) + "," + std::to_string(points[i].second) + "\n";
    return text;
  }
  fs::path folder_;
};

TEST_F(ImportedSet, ReadsBackAsAMeasurementSet) {
  const Import import = import_exports({}, kExports / "clean/specimens.csv");
  std::vector<SpecimenRecord> records;
  for (const ImportedSpecimen& one : import.specimens) records.push_back(one.record);
  write_measurement_set(folder_ / "set", records);
  const MeasurementSet set = read_measurement_set(folder_ / "set");
  EXPECT_TRUE(set.rejected.empty());
  EXPECT_EQ(set.specimens, records);
  EXPECT_TRUE(set.warnings.empty()) << set.warnings.front();
}

TEST_F(ImportedSet, ASheetOfAGermanSpreadsheetIsRead) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const Import import = this->import(
      "file;specimen;pattern;width_mm;thickness_mm;gauge_mm;test\na.csv;A1;mix:0.65;52,04;3,21;54;toughness\n");
  ASSERT_EQ(import.specimens.size(), 1U);
  EXPECT_EQ(import.specimens[0].record.conditions.thickness_mm, 3.21);
  EXPECT_NEAR(import.specimens[0].test.modulus_pa, 800e6 * 52 * 3.2 / 52.04 / 3.21, 4e6);
}

TEST_F(ImportedSet, ANotchedSpecimenThatWasUnloadedWholeIsKeptAsNotValid) {
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i <= 40; ++i) {
    const int left = 20 - std::abs(i - 20);
    points.emplace_back(0.05 * left, (i <= 20 ? 50.0 : 40.0) * left);
  }
  write("a.csv", table(points, "time_s,extension_mm,force_n"));
  const Import import =
      this->import("file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,A1,rigid,52,3.2,54\n");
  ASSERT_EQ(import.specimens.size(), 1U);
  EXPECT_FALSE(import.specimens[0].record.valid);
  EXPECT_THAT(import.specimens[0].record.note, HasSubstr("not separated: the strain returns with the force"));
}

TEST_F(ImportedSet, TheModulusOfABarComesFromTheColumnThatTheSheetNames) {
  // The extensometer sees 50 mm of a bar of 2 GPa; the grips travel three times as far.
  std::string text = "Time (s),Extension (mm),Load (N),Extensometer (mm)\n";
  for (int i = 0; i <= 200; ++i) {
    const double strain = 1e-4 * i, force = std::min(2e3 * strain, 20.0) * 13 * 3.2;
    text += fmt::format("{},{},{},{}\n", i, 3 * 50 * strain, force, 50 * strain);
  }
  write("bar.csv", text);
  const std::string heading = "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,extension_column\n";
  const Import chosen = import(heading + "bar.csv,B1,rigid,modulus,13,3.2,50,Extensometer\n");
  ASSERT_EQ(chosen.specimens.size(), 1U);
  EXPECT_NEAR(*chosen.specimens[0].record.modulus_pa, 2e9, 1e7);
  const Import usual = import(heading + "bar.csv,B1,rigid,modulus,13,3.2,50,\n");
  EXPECT_NEAR(*usual.specimens[0].record.modulus_pa, 2e9 / 3, 1e7);
  const Import absent = import(heading + "bar.csv,B1,rigid,modulus,13,3.2,50,Laser\n");
  ASSERT_EQ(absent.rejected.size(), 1U);
  EXPECT_THAT(absent.rejected[0].reason, AllOf(HasSubstr("no column `Laser`"), HasSubstr("Extensometer")));
}

TEST_F(ImportedSet, AnExtensionThatDoesNotBelongToTheGaugeIsSaid) {
  const auto doubts = [&](const std::string& columns, const std::string& row) {
    std::string text = columns + "\n";
    for (int i = 0; i <= 200; ++i) text += fmt::format("{},{},{},{}\n", i, 0.015 * i, 0.005 * i, 8 * i);
    write("bar.csv", text);
    std::string all;
    for (const std::string& warning :
         import("file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,extension_column\nbar.csv,B1,rigid," + row)
             .warnings)
      all += warning + "\n";
    return all;
  };
  const std::string both = "Time (s),Crosshead (mm),Extensometer (mm),Load (N)";
  EXPECT_THAT(doubts(both, "modulus,13,3.2,50,\n"),
              AllOf(HasSubstr("specimen B1: gauge_mm 50 is an extensometer's, but the extension is that of `Crosshead"),
                    HasSubstr("the file also has `Extensometer (mm)`"), HasSubstr("expected extension_column")));
  EXPECT_EQ(doubts(both, "modulus,13,3.2,50,Extensometer\n"), "");
  EXPECT_EQ(doubts(both, "modulus,13,3.2,104.9,\n"), "");
  EXPECT_THAT(doubts(both, "toughness,52,3.2,54,\n"), Not(HasSubstr("gauge_mm")))
      << "a notched specimen is strained by its grips";
  EXPECT_THAT(doubts(both, "modulus,13,3.2,104.9,Extensometer\n"), HasSubstr("longer than a bar's narrow section"));
  EXPECT_THAT(doubts("Time (s),Extension (mm),Extension (mm),Load (N)", "modulus,13,3.2,104.9,\n"),
              HasSubstr("`Extension (mm)` occurs twice"));
  EXPECT_EQ(doubts("Time (s),Extension (mm),Temperature (C),Load (N)", "modulus,13,3.2,50,\n"), "")
      << "a name that may mean either";
}

TEST_F(ImportedSet, OneTestUnderTwoNamesIsDoubted) {
  for (const char* name : {"a.csv", "copy.csv"}) fs::copy_file(kExports / "clean/plain.csv", folder_ / name);
  const std::string heading = "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\n";
  const Import at_once = import(heading + "a.csv,A1,rigid,52,3.2,54\ncopy.csv,A2,rigid,52,3.2,54\n");
  ASSERT_EQ(at_once.warnings.size(), 1U);
  EXPECT_THAT(at_once.warnings[0], HasSubstr("specimen A2: its readings equal those of A1 to the last digit"));
  Import first = import(heading + "a.csv,A1,rigid,52,3.2,54\n"), later = import(heading + "a.csv,A2,rigid,52,3.2,54\n");
  write_import(folder_ / "set", "sheet.csv", first);
  write_import(folder_ / "set", "sheet.csv", later);
  ASSERT_EQ(later.warnings.size(), 1U);
  EXPECT_THAT(later.warnings[0], HasSubstr("specimen A2: its readings equal those of A1"));
  Import again = import(heading + "a.csv,A2,rigid,52,3.2,54\n");
  write_import(folder_ / "set", "sheet.csv", again);
  EXPECT_TRUE(again.warnings.empty()) << "said once";
}

TEST_F(ImportedSet, ExportsAreFoundByNameAndUnusedOnesAreSaid) {
  fs::create_directories(folder_ / "machine");
  for (const char* name : {"a.csv", "b.csv"}) fs::copy_file(kExports / "clean/plain.csv", folder_ / "machine" / name);
  write("sheet.csv", "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,A1,rigid,52,3.2,54\n");
  const Import import = import_exports({folder_ / "machine/a.csv", folder_ / "machine/b.csv"}, folder_ / "sheet.csv");
  EXPECT_EQ(import.specimens.size(), 1U);
  ASSERT_EQ(import.warnings.size(), 1U);
  EXPECT_THAT(import.warnings[0], HasSubstr("b.csv: no specimen of the sheet names this export"));
}

TEST_F(ImportedSet, RowsTornAtDecimalCommasAreNamed) {
  write("a.csv", "time_s,extension_mm,force_n\n0,0,0\n0,4,0,013,2,02\n0,8,0,027,4,05\n1,2,0,04,6,1\n1,6,0,05,8,1\n");
  const Import import =
      this->import("file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,A1,rigid,52,3.2,54\n");
  ASSERT_EQ(import.rejected.size(), 1U);
  EXPECT_EQ(import.rejected[0].line, 3);
  EXPECT_THAT(import.rejected[0].reason, HasSubstr("has 6 cells, expected 3: decimal commas"));
}

TEST_F(ImportedSet, SizesAndValuesThatUnitsExplainAreDoubted) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const auto doubts = [&](const std::string& size) {
    const Import import = this->import("file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,A1,rigid," + size);
    std::string all;
    for (const std::string& warning : import.warnings) all += warning + "\n";
    return all;
  };
  EXPECT_EQ(doubts("52,3.2,54\n"), "");
  EXPECT_EQ(doubts("50,6.2,54\n"), "");
  EXPECT_THAT(doubts("5.2,3.2,54\n"), HasSubstr("5.2 x 3.2 mm in the gauge, nominal 52 x 3.2 mm"));
  EXPECT_THAT(doubts("52,0.0032,54\n"), HasSubstr("are width_mm and thickness_mm right?"));
  EXPECT_THAT(doubts("0.052,0.0032,54\n"), HasSubstr("peak stress 5.96e+12 Pa is unusual"));
  EXPECT_THAT(doubts("52,3.2,0.054\n"), HasSubstr("failure strain 30.4 is unusual"));
}

TEST_F(ImportedSet, ADoubtIsTheSpecimensAndSaysWhetherItIsOfScale) {
  const std::string record = read_file(kExports / "clean/plain.csv");
  write("a.csv", record);
  write("b.csv", record.substr(0, record.rfind('\n', record.size() - 2) + 1));  // no twin
  const Import import = this->import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,A1,rigid,52,0.32,54\nb.csv,B1,rigid,52,3.2,54\n");
  const auto specimens = by_name(import);
  const std::vector<ImportDoubt>& doubts = specimens.at("A1").doubts;
  ASSERT_FALSE(doubts.empty());
  EXPECT_TRUE(doubts.front().is_of_scale);
  EXPECT_THAT(doubts.front().text, HasSubstr("are width_mm and thickness_mm right?"));
  EXPECT_EQ(import.warnings.front(), "specimen A1: " + doubts.front().text);
  for (const ImportDoubt& doubt : specimens.at("B1").doubts)
    EXPECT_THAT(doubt.text, HasSubstr("replicates")) << "its own record is sound";
}

TEST_F(ImportedSet, AConfinedSheetReadsNothingOutsideItsFolder) {
  const std::string heading = "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\n";
  const fs::path layout = fs::path(NACRE_SOURCE_DIR) / "data/patterns/published_a.txt";
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  fs::copy_file(layout, folder_ / "own.txt");
  const std::string outside = (kExports / "clean/plain.csv").string();
  const std::string sheet = heading + "a.csv,A,own.txt,52,3.2,54\na.csv,B," + layout.string() + ",52,3.2,54\n" +
                            outside + ",C,rigid,52,3.2,54\na.csv,D,../own.txt,52,3.2,54\n";
  const Import confined = import(sheet, {.confined = true});
  EXPECT_EQ(by_name(confined).at("A").record.design.name(), "577fffe9fffdef");
  ASSERT_EQ(confined.rejected.size(), 3U);
  for (const ImportFault& fault : confined.rejected) {
    EXPECT_THAT(fault.reason, HasSubstr("leads out of the sheet's folder"));
    EXPECT_THAT(fault.specimen, testing::AnyOf("B", "C", "D"));
  }
}

TEST_F(ImportedSet, ATestIsOneSpecimen) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const Import import = this->import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm,part\n"
      "a.csv,A1,rigid,52,3.2,54,\n./a.csv,A2,rigid,52,3.2,54,1\n");
  EXPECT_EQ(import.specimens.size(), 1U);
  ASSERT_EQ(import.rejected.size(), 1U);
  EXPECT_EQ(import.rejected[0].line, 3);
  EXPECT_THAT(import.rejected[0].reason, HasSubstr("`./a.csv` is already specimen A1 (line 2)"));
}

TEST_F(ImportedSet, APatternThatIsNoRegularFileIsRefusedAndNotWaitedFor) {
  const Import imported = import("file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,s1,/dev/stdin,10,3,50\n");
  ASSERT_FALSE(imported.rejected.empty());
  EXPECT_THAT(to_string(imported.rejected.front()), HasSubstr("not a regular file"));
}

TEST_F(ImportedSet, WhatNoMessageCouldHoldIsRejectedWithItsColumn) {
  const Import sheet = import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm,print_order\n"
      "a.csv," +
      std::string(201, 'n') + ",soft,10,3.2,50,\nb.csv,b,soft,10,1001,50,\nc.csv,c,soft,10,3.2,50,0\n");
  ASSERT_EQ(sheet.rejected.size(), 3U);
  EXPECT_EQ(sheet.rejected[0].column, "specimen");
  EXPECT_EQ(sheet.rejected[1].column, "thickness_mm");
  EXPECT_EQ(sheet.rejected[2].column, "print_order");
}

TEST_F(ImportedSet, ASheetHasOneDecimalMark) {
  for (const char* name : {"a.csv", "b.csv"}) fs::copy_file(kExports / "clean/plain.csv", folder_ / name);
  const auto thickness_mm = [&](const std::string& heading, const std::string& rows) {
    std::vector<double> found;
    for (const auto& one : import(heading + rows).specimens) found.push_back(one.record.conditions.thickness_mm);
    return found;
  };
  const std::string semicolons = "file;specimen;pattern;width_mm;thickness_mm;gauge_mm\n",
                    commas = "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\n";
  using testing::ElementsAre;
  EXPECT_THAT(thickness_mm(semicolons, "a.csv;A;rigid;51,950;9,875;54\nb.csv;B;rigid;52;3,21;54\n"),
              ElementsAre(9.875, 3.21));
  EXPECT_THAT(thickness_mm(semicolons, "a.csv;A;rigid;51,950;9,875;54\n"), ElementsAre(9.875));
  EXPECT_THAT(thickness_mm(semicolons, "a.csv;A;rigid;51.950;9.875;54\n"), ElementsAre(9.875));
  EXPECT_THAT(thickness_mm(commas, "a.csv,A,rigid,\"51,950\",\"3,21\",54\n"), ElementsAre(3.21));
  EXPECT_THAT(thickness_mm(commas, "a.csv,A,rigid,\"1,013\",3.2,54\n"), ElementsAre(3.2));
}

TEST_F(ImportedSet, ANumberThatMayBeEitherIsRejectedWhereASheetHasBothDecimalMarks) {
  for (const char* name : {"a.csv", "b.csv"}) fs::copy_file(kExports / "clean/plain.csv", folder_ / name);
  const Import sheet = import(
      "file;specimen;pattern;width_mm;thickness_mm;gauge_mm\n"
      "a.csv;A;rigid;52,04;3.21;54\nb.csv;B;rigid;52,04;9,875;54\n");
  ASSERT_EQ(sheet.specimens.size(), 1U);
  EXPECT_EQ(sheet.specimens[0].record.conditions.thickness_mm, 3.21);
  ASSERT_EQ(sheet.rejected.size(), 1U);
  EXPECT_EQ(sheet.rejected[0].line, 3);
  EXPECT_THAT(sheet.rejected[0].reason, HasSubstr("`9,875` may have a decimal mark or grouped thousands"));
}

TEST_F(ImportedSet, ACellInQuotesMayHoldALineBreak) {
  for (const char* name : {"a.csv", "b.csv"}) fs::copy_file(kExports / "clean/plain.csv", folder_ / name);
  const Import sheet = import(
      "file;specimen;pattern;width_mm;thickness_mm;gauge_mm;note\r\n"
      "a.csv;A1;rigid;52;3.2;54;\"bubble;\r\nsaid \"\"large\"\"\"\r\n"
      "b.csv;B1;rigid;52;3.2;54;5\" bar\r\n"
      "c.csv;C1;rigid;52;3.2;54;\r\n");
  ASSERT_EQ(sheet.specimens.size(), 2U);
  EXPECT_EQ(sheet.specimens[0].record.note, "bubble;\r\nsaid \"large\"");
  EXPECT_EQ(sheet.specimens[1].record.note, "5\" bar");
  ASSERT_EQ(sheet.rejected.size(), 1U);
  EXPECT_EQ(sheet.rejected[0].line, 5);
}

TEST_F(ImportedSet, AQuoteThatIsNeverClosedLosesItsRowAlone) {
  for (const char* name : {"a.csv", "b.csv"}) fs::copy_file(kExports / "clean/plain.csv", folder_ / name);
  const Import sheet = import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm,note\n"
      "a.csv,\"A1,rigid,52,3.2,54,\n"
      "b.csv,B1,rigid,52,3.2,54,\"a \"\"bubble\"\"\"\n");
  ASSERT_EQ(sheet.specimens.size(), 1U);
  EXPECT_EQ(sheet.specimens[0].record.note, "a \"bubble\"");
  ASSERT_EQ(sheet.rejected.size(), 1U);
  EXPECT_EQ(sheet.rejected[0].line, 2);
  EXPECT_THAT(sheet.rejected[0].reason, HasSubstr("never closed"));
}

TEST_F(ImportedSet, WhatTheSetWorksOutItselfIsNotTakenFromTheSheet) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const Import sheet = import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm,modulus_pa,curve,peak_stress_pa,colour\n"
      "a.csv,A1,rigid,52,3.2,54,5,mine.csv,7,red\n");
  ASSERT_EQ(sheet.specimens.size(), 1U);
  const auto& kept = sheet.specimens[0].record.other_columns;
  EXPECT_EQ(kept.at("colour"), "red");
  EXPECT_FALSE(kept.contains("modulus_pa") || kept.contains("curve"));
  EXPECT_NE(kept.at("peak_stress_pa"), "7");
  ASSERT_EQ(sheet.warnings.size(), 4U);
  for (const std::size_t i : {0, 1, 2})
    EXPECT_THAT(sheet.warnings[i], HasSubstr("is dropped: the measurement set has"));
  EXPECT_THAT(sheet.warnings[3], HasSubstr("`colour` is kept but not used"));
}

TEST_F(ImportedSet, ALineThatNamesTheSeparatorIsPassedOver) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const Import sheet = import(
      "sep=;\nfile;specimen;pattern;width_mm;thickness_mm;gauge_mm;part\n"
      "a.csv;A1;rigid;52;3.2;54;\na.csv;A2;rigid;52;3.2;54;1.5\n");
  EXPECT_EQ(sheet.specimens.size(), 1U);
  ASSERT_EQ(sheet.rejected.size(), 1U);
  EXPECT_EQ(sheet.rejected[0].line, 4);
}

TEST_F(ImportedSet, WhatTheSetWouldRefuseIsRejectedWithTheSheet) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const Import sheet = import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm,test,valid\n"
      "a.csv,A1,577fffe9fffdef,13,3.2,50,tensile,\na.csv,A2,577fffe9fffdef,13,3.2,50,tensile,0\n"
      "a.csv,A\a3,rigid,52,3.2,54,,\n");
  EXPECT_EQ(sheet.specimens.size(), 1U) << "a failed test need not have a result";
  ASSERT_EQ(sheet.rejected.size(), 2U);
  EXPECT_THAT(sheet.rejected[0].reason, HasSubstr("a tensile coupon is homogeneous"));
  EXPECT_THAT(sheet.rejected[1].reason, HasSubstr("control character"));
}

TEST_F(ImportedSet, PartAndPrintOrderAreIntegers) {
  fs::copy_file(kExports / "clean/plain.csv", folder_ / "a.csv");
  const Import sheet = import(
      "file,specimen,pattern,width_mm,thickness_mm,gauge_mm,part,print_order\n"
      "a.csv,A1,rigid,52,3.2,54,1.5,\na.csv,A2,rigid,52,3.2,54,,2.7\na.csv,A3,rigid,52,3.2,54,1,2\n");
  ASSERT_EQ(sheet.specimens.size(), 1U);
  EXPECT_EQ(sheet.specimens[0].record.print_order, 2);
  ASSERT_EQ(sheet.rejected.size(), 2U);
  EXPECT_EQ(to_string(sheet.rejected[0]),
            (folder_ / "sheet.csv").string() + ":2: part: `1.5`, expected an integer from 1");
  EXPECT_EQ(sheet.rejected[1].line, 3);
  EXPECT_THAT(sheet.rejected[1].reason, HasSubstr("`2.7`, expected an integer from 1"));
}

const std::string kBarSheet =
    "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm\na.csv,A,rigid,modulus,13,3.2,50\n";

TEST_F(ImportedSet, ABarThatIsUnloadedIsUsedWhateverNoiseLeavesOfItsArea) {
  for (const double sign : {1.0, -1.0}) {  // of the work that noise adds on unloading
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i <= 200; ++i) {
      const double strain = 3e-5 * (100 - std::abs(i - 100));
      points.emplace_back(50 * strain, 2e3 * strain * 41.6 + (i > 100 ? -0.5 * sign : 0.0));
    }
    write("a.csv", table(points, "time_s,extension_mm,force_n"));
    const Import import = this->import(kBarSheet);
    ASSERT_EQ(import.specimens.size(), 1U) << to_string(import.rejected.front());
    EXPECT_NEAR(*import.specimens[0].record.modulus_pa, 2e9, 1e7);
    EXPECT_TRUE(import.specimens[0].record.valid);
  }
}

TEST_F(ImportedSet, WhatIsUnsureOfABarIsSaid) {
  const auto warnings_of = [&](const std::string& heading, double slack, double noise_n) {
    RandomStream random(5, "bars");
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i <= 200; ++i) {
      const double strain = 4e-4 * i;
      points.emplace_back(50 * strain, std::max(0.0, 2e3 * (strain - slack)) * 41.6 + noise_n * random.normal());
    }
    write("a.csv", table(points, heading));
    std::string all;
    for (const std::string& warning : this->import(kBarSheet).warnings) all += warning + "\n";
    return all;
  };
  EXPECT_EQ(warnings_of("time_s,extension_mm,force_n", 0.004, 10.0), "");
  EXPECT_THAT(warnings_of("time_s,extension_mm,force_n", 0.03, 0.0),
              HasSubstr("meets zero stress at 3.00 % strain; a toe beyond 1 % is not compensated"));
  EXPECT_THAT(warnings_of("time_s,extension_mm,force_n", 0.0, 600.0),
              HasSubstr("is the force noisy, or the curve bent?"));
}

TEST_F(ImportedSet, ADefaultRateBesideATimeColumnIsSaid) {
  std::string text = "time_s,extension_mm,force_n\n";
  for (int i = 0; i <= 50; ++i) text += fmt::format("0,{},{}\n", 0.005 * i, 8.0 * i);
  write("a.csv", text);
  const Import import = this->import(kBarSheet);
  ASSERT_EQ(import.warnings.size(), 1U);
  EXPECT_THAT(import.warnings[0],
              HasSubstr("A: no strain rate can be computed from its times; 0.000617 1/s is assumed"));
}

TEST_F(ImportedSet, ThePlannedRateStandsWhereTheRecordTellsNoneAndAnotherThanPlannedIsSaid) {
  const auto import_bar = [&](bool with_time, const std::string& rates) {
    std::string text = with_time ? "time_s,extension_mm,force_n\n" : "extension_mm,force_n\n";
    for (int i = 0; i <= 200; ++i) {  // at 1e-4 /s
      const double strain = 1e-4 * i;
      if (with_time) text += fmt::format("{},", i);
      text += fmt::format("{},{}\n", 50 * strain, 2e3 * strain * 41.6);
    }
    write("a.csv", text);
    return this->import(
        "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,planned_strain_rate_per_s,strain_rate_per_s,loading"
        "\na.csv,A,rigid,tensile,13,3.2,50," +
        rates + ",to 2 % strain\n");
  };
  const auto rate_of = [](const Import& import) { return import.specimens.at(0).record.conditions.strain_rate_per_s; };
  EXPECT_EQ(rate_of(import_bar(false, "0.00617,")), 0.00617);
  EXPECT_EQ(rate_of(import_bar(false, ",")), 6.17e-4);
  const Import as_planned = import_bar(true, "0.00011,"), faster = import_bar(true, "0.001,");
  EXPECT_EQ(rate_of(as_planned), 1e-4) << "the clock knows better than the plan";
  EXPECT_TRUE(as_planned.warnings.empty()) << as_planned.warnings.front();
  EXPECT_FALSE(as_planned.specimens[0].record.other_columns.contains("loading"));
  EXPECT_EQ(rate_of(faster), 1e-4);
  ASSERT_EQ(faster.warnings.size(), 1U);
  EXPECT_THAT(faster.warnings[0], HasSubstr("A: strain rate 0.0001 1/s, planned 0.001: was the speed different"));
  EXPECT_EQ(rate_of(import_bar(true, "0.001,0.002")), 0.002) << "a person's value counts";
  EXPECT_EQ(import_bar(false, "fast,").rejected.at(0).column, "planned_strain_rate_per_s");
}

TEST_F(ImportedSet, ASheetWithoutARequiredColumnIsRefused) {
  write("sheet.csv", "file,specimen,pattern,width_mm,gauge_mm\n");
  EXPECT_THROW(import_exports({}, folder_ / "sheet.csv"), InputError);
  write("sheet.csv", "");
  EXPECT_THROW(import_exports({}, folder_ / "sheet.csv"), InputError);
}

}  // namespace
}  // namespace nacre::measurement
