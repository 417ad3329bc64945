#include "measurement/set_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/files.hpp"
#include "base/result.hpp"
#include "measurement/import.hpp"
#include "measurement/read_set.hpp"
#include "measurement/write_import.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TableOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("nacre-set-table-" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "set/curves");
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string text(const std::string& name) const { return read_file(folder_ / name); }
  fs::path folder_;
};

TEST_F(TableOnDisk, AJudgementChangesItsRowAndNothingElse) {
  write("set/measurements.csv",
        "note,specimen,pattern,test,modulus_pa,curve,colour\n"
        "old,S1,a.txt,modulus,2.0e9,curves/raw.csv,\"red, dull\"\n"
        ",S2,nonsense,modulus,2e9,,blue\n");
  write("set/curves/raw.csv", "strain,stress_pa,time_s\n");
  SetTable table(folder_ / "set");
  table.review("S1", false, "bubble (me)");
  table.write(folder_ / "set");
  EXPECT_EQ(text("set/measurements.csv"),
            "note,specimen,pattern,test,modulus_pa,curve,colour,valid\n"
            "old; bubble (me),S1,a.txt,modulus,2.0e9,curves/raw.csv,\"red, dull\",0\n"
            ",S2,nonsense,modulus,2e9,,blue,\n");
  EXPECT_EQ(text("set/curves/raw.csv"), "strain,stress_pa,time_s\n");
}

TEST_F(TableOnDisk, ARowThatCouldNotBeWrittenBackIsRefused) {
  write("set/measurements.csv", "specimen,pattern,test,modulus_pa\nS1,rigid,modulus,2e9\nS2,\"rigid,modulus,2e9\n");
  try {
    SetTable table(folder_ / "set");
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("measurements.csv:3:4"));
  }
}

/// Imports of one machine's exports `a.csv`, `b.csv`, ... into one set.
class RepeatedImport : public TableOnDisk {
 protected:
  void SetUp() override {
    TableOnDisk::SetUp();
    fs::remove_all(folder_ / "set");
    const fs::path plain = fs::path(NACRE_SOURCE_DIR) / "tests/unit/measurement/data/exports/clean/plain.csv";
    for (const char* name : {"a.csv", "b.csv"}) fs::copy_file(plain, folder_ / name);
  }
  Import import(const std::string& rows) const {
    write("sheet.csv", "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\n" + rows);
    Import import = import_exports({}, folder_ / "sheet.csv");
    write_import(folder_ / "set", "sheet.csv", import);
    return import;
  }
  std::vector<SpecimenRecord> specimens() const { return read_measurement_set(folder_ / "set").specimens; }
};

TEST_F(RepeatedImport, AddsToTheSetAndKeepsWhatAPersonJudged) {
  import("a.csv,A,rigid,52,3.2,54\n");
  SetTable table(folder_ / "set");
  table.review("A", false, "bubble (me)");
  table.write(folder_ / "set");
  const Import second = import("b.csv,B,soft,52,3.2,54\na.csv,A,rigid,52,3.2,54\n");
  EXPECT_EQ(second.known, 1);
  ASSERT_EQ(second.specimens.size(), 2U);
  EXPECT_FALSE(second.specimens[1].record.valid) << "as in the set";
  const auto set = specimens();
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].specimen, "A");
  EXPECT_FALSE(set[0].valid);
  EXPECT_EQ(set[0].note, "bubble (me)");
  EXPECT_EQ(set[1].specimen, "B");
  EXPECT_FALSE(set[1].curve.empty());
}

TEST_F(RepeatedImport, RejectsAKnownNameWithAnotherTestAndKeepsTheOldOne) {
  import("a.csv,A,rigid,52,3.2,54\n");
  const std::string before = text("set/measurements.csv"), curve = text("set/curves/A.csv");
  const Import second = import("a.csv,A,rigid,50,3.2,54\n");
  EXPECT_TRUE(second.specimens.empty());
  ASSERT_EQ(second.rejected.size(), 1U);
  EXPECT_EQ(second.rejected[0].line, 2);
  EXPECT_THAT(second.rejected[0].reason, HasSubstr("`A` is already in"));
  EXPECT_EQ(text("set/measurements.csv"), before);
  EXPECT_EQ(text("set/curves/A.csv"), curve);
}

TEST_F(RepeatedImport, ReplacesOnlyWhenToldToAndKeepsTheJudgement) {
  import("a.csv,A,rigid,52,3.2,54\nb.csv,B,soft,52,3.2,54\n");
  SetTable table(folder_ / "set");
  table.review("A", false, "bubble (me)");
  table.write(folder_ / "set");
  const double before_pa = *specimens()[0].toughness_pa;
  write("sheet.csv", "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\na.csv,A,rigid,26,3.2,54\n");
  Import corrected = import_exports({}, folder_ / "sheet.csv");
  write_import(folder_ / "set", "sheet.csv", corrected, true);
  EXPECT_EQ(corrected.replaced, 1);
  EXPECT_TRUE(corrected.rejected.empty());
  const auto set = specimens();
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0].specimen, "B") << "as it was";
  EXPECT_EQ(set[1].specimen, "A");
  EXPECT_NEAR(*set[1].toughness_pa, 2.0 * before_pa, 1e-4 * before_pa) << "half as wide";
  EXPECT_NEAR(tester::area_under(set[1].curve), *set[1].toughness_pa, 1e-4 * before_pa) << "and its curve";
  EXPECT_FALSE(set[1].valid);
  EXPECT_EQ(set[1].note, "bubble (me)");
}

TEST_F(RepeatedImport, GivesANewSpecimenNoCurveFileOfAnother) {
  import("a.csv,A 1,rigid,52,3.2,54\n");  // curves/A_1.csv
  import("b.csv,A_1,soft,50,3.2,54\n");
  const auto set = specimens();
  ASSERT_EQ(set.size(), 2U);
  EXPECT_NE(set[0].curve, set[1].curve);
}

TEST_F(RepeatedImport, WritesOverNoRawExportThatLiesAmongTheCurves) {
  fs::create_directories(folder_ / "curves");
  fs::rename(folder_ / "a.csv", folder_ / "curves/t1.csv");
  const std::string raw = text("curves/t1.csv");
  write("sheet.csv",
        "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\n"
        "curves/t1.csv,t1,rigid,52,3.2,54\n");
  Import import = import_exports({}, folder_ / "sheet.csv");
  write_import(folder_, "sheet.csv", import);
  EXPECT_EQ(text("curves/t1.csv"), raw);
  const auto set = read_measurement_set(folder_).specimens;
  ASSERT_EQ(set.size(), 1U);
  EXPECT_EQ(set[0].curve, import.specimens[0].test.curve);
}

}  // namespace
}  // namespace nacre::measurement
