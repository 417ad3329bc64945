#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "base/files.hpp"
#include "measurement/limits.hpp"
#include "measurement/read_set.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/summary.hpp"
#include "measurement/write_set.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kSmallSet = fs::path(NACRE_SOURCE_DIR) / "tests/unit/measurement/data/small";

/// A measurement set in a folder that is removed at the end of the test.
class SetOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "nacre-set-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  MeasurementSet read(const std::string& table) {
    write("measurements.csv", table);
    return read_measurement_set(folder_);
  }
  /// The only rejected row of a set that holds it and a good one.
  RejectedRow rejected(const std::string& header, const std::string& row) {
    const std::string empty_cells(static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) - 3, ',');
    const MeasurementSet set = read(header + "\n" + row + "\nGOOD,soft,modulus,1e6" + empty_cells + "\n");
    EXPECT_EQ(set.rejected.size(), 1u) << row;
    return set.rejected.empty() ? RejectedRow{} : set.rejected.front();
  }
  std::string error_of(const std::string& table) {
    try {
      read(table);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

constexpr const char* kShort = "specimen,pattern,test,modulus_pa\n";

// A specimen that broke in the grips has no result, and yet is worth a row.
TEST_F(SetOnDisk, AnInvalidSpecimenNeedNoResult) {
  const MeasurementSet set = read(
      "specimen,pattern,test,modulus_pa,toughness_pa,valid,note\n"
      "A,577fffe9fffdef,toughness,,,0,broke in the grips\nB,soft,modulus,1e6,,,\nC,soft,modulus,,,1,\n");
  ASSERT_EQ(set.specimens.size(), 2u);
  EXPECT_FALSE(set.specimens[0].valid);
  EXPECT_TRUE(missing_result(set.specimens[0]));
  ASSERT_EQ(set.rejected.size(), 1u);
  EXPECT_EQ(set.rejected[0].column, "modulus_pa");
}

TEST_F(SetOnDisk, CouponsGoByTheirNames) {
  const MeasurementSet set =
      read(std::string(kShort) +
           "A,checkerboard:2,modulus,1e9\nB,laminate:x:3:2,modulus,1e9\nC,checkerboard:3,modulus,1e9\n");
  ASSERT_EQ(set.specimens.size(), 2u);
  EXPECT_NE(set.specimens[0].design.layout(), nullptr);
  ASSERT_EQ(set.rejected.size(), 1u);
  EXPECT_THAT(set.rejected[0].reason, HasSubstr("1, 2, 5"));
}

TEST_F(SetOnDisk, APrintOrderBelowOneCountsAsUnknown) {
  const MeasurementSet set = read(
      "specimen,pattern,test,modulus_pa,print_order\nA,soft,modulus,1e6,0\nB,soft,modulus,1e6,-3\n"
      "C,soft,modulus,1e6,\nD,soft,modulus,1e6,4\n");
  ASSERT_EQ(set.specimens.size(), 4u);
  EXPECT_EQ(set.specimens[0].print_order, 0);
  EXPECT_EQ(set.specimens[1].print_order, 0);
  EXPECT_EQ(set.specimens[3].print_order, 4);
  EXPECT_EQ(
      std::ranges::count_if(set.warnings, [](const std::string& each) { return each.find("unknown") != each.npos; }),
      2);
}

TEST_F(SetOnDisk, EveryRowThatCannotBeUsedIsNamedWhenNoneCan) {
  const std::string error = error_of(std::string(kShort) + "A,nothing.txt,modulus,1e6\nB,soft,modulus,abc\n");
  EXPECT_THAT(error, HasSubstr("line 2: column pattern"));
  EXPECT_THAT(error, HasSubstr("line 3: column modulus_pa"));
}

// Units that were forgotten are what people get wrong most often.
TEST_F(SetOnDisk, CurvesInOtherUnitsAndUnfinishedPullsAreDoubted) {
  const std::string heading = "specimen,pattern,test,curve\n", row = "A,577fffe9fffdef,toughness,a.csv\n";
  const auto doubts = [&](const std::string& points) {
    write("a.csv", "strain,stress_pa\n" + points);
    const MeasurementSet set = read(heading + row);
    return set.warnings.empty() ? std::string() : set.warnings.front();
  };
  EXPECT_EQ(doubts("0,0\n0.01,5e6\n0.02,9e6\n0.03,6e6\n0.04,0\n"), "");
  EXPECT_THAT(doubts("0,0\n0.01,5\n0.02,900\n0.03,6\n0.04,0\n"), HasSubstr("is the unit Pa?"));
  EXPECT_THAT(doubts("0,0\n1,5e6\n2,9e6\n3,6e6\n4,0\n"),
              HasSubstr("measurements.csv:2: column curve: strain reaches 4"));
  EXPECT_THAT(doubts("0,0\n0.01,5e6\n0.02,9e6\n0.03,8e6\n0.04,7.2e6\n"), HasSubstr("ends at 80 %"));
}

TEST(SmallSet, EveryKindOfRowIsUnderstood) {
  const MeasurementSet set = read_measurement_set(kSmallSet);
  EXPECT_TRUE(set.rejected.empty());
  EXPECT_TRUE(set.warnings.empty());
  ASSERT_EQ(set.specimens.size(), 8u);
  EXPECT_EQ(set.specimens[0].design, set.specimens[1].design);  // a key and a file of the same pattern
  EXPECT_EQ(set.specimens[0].conditions, set.specimens[1].conditions);
  EXPECT_EQ(set.specimens[2].curve.size(), 5u);
  EXPECT_FALSE(set.specimens[4].valid);
  EXPECT_EQ(set.specimens[4].note, "slipped in the grip, then broke there");
  EXPECT_EQ(set.specimens[5].conditions.orientation_deg, 90.0);
  EXPECT_EQ(set.specimens[6].test, tester::TestKind::tensile);
  EXPECT_EQ(set.specimens[6].curve.strain[3], 0.015);  // unloading is kept
  EXPECT_EQ(set.specimens[7].design.name(), "interface");
}

TEST(ExampleSet, IsReadWithoutComplaint) {
  const MeasurementSet set = read_measurement_set(fs::path(NACRE_SOURCE_DIR) / "data/examples/round1");
  EXPECT_TRUE(set.rejected.empty());
  EXPECT_TRUE(set.warnings.empty());
  EXPECT_EQ(set.specimens.size(), 18u);
  const std::vector<Replicates> designs = summarise(set.specimens);
  ASSERT_EQ(designs.size(), 3u);  // a pattern named by file and by key is one design
  EXPECT_EQ(designs[0].modulus_count, 3);
  EXPECT_EQ(designs[2].toughness_count, 2);  // one is not valid
}

TEST_F(SetOnDisk, OrderOfColumnsMarkAndLineEndingsDoNotMatter) {
  const MeasurementSet set = read(
      "\xEF\xBB\xBF"
      "note,modulus_pa,test,pattern,specimen\r\n\"a, b\",2e9,modulus,rigid,S1\r\n");
  ASSERT_EQ(set.specimens.size(), 1u);
  EXPECT_EQ(set.specimens[0].note, "a, b");
  EXPECT_EQ(set.specimens[0].modulus_pa, 2e9);
  EXPECT_EQ(set.specimens[0].conditions, tester::TestConditions{});
  EXPECT_TRUE(set.specimens[0].valid);
}

TEST_F(SetOnDisk, UnknownColumnsAreWarnedAboutAndKept) {
  const MeasurementSet set = read("specimen,pattern,test,modulus_pa,colour,Note\nS1,rigid,modulus,2e9,Ada,\n");
  ASSERT_EQ(set.warnings.size(), 2u);
  EXPECT_THAT(set.warnings[0], HasSubstr("colour"));
  EXPECT_THAT(set.warnings[1], HasSubstr("is `note` meant?"));
  EXPECT_EQ(set.specimens[0].other_columns.at("colour"), "Ada");
  write_measurement_set(folder_ / "copy", set.specimens);
  EXPECT_EQ(read_measurement_set(folder_ / "copy").specimens, set.specimens);
}

TEST_F(SetOnDisk, UnknownColumnsOfOneNameAreBothKept) {
  const MeasurementSet set = read("specimen,pattern,test,modulus_pa,x,x\nS1,rigid,modulus,2e9,left,right\n");
  ASSERT_EQ(set.warnings.size(), 2u);
  EXPECT_EQ(set.specimens[0].other_columns.at("x"), "left");
  EXPECT_EQ(set.specimens[0].other_columns.at("x~2"), "right");
}

TEST_F(SetOnDisk, OneBadRowDoesNotLoseTheOthers) {
  const MeasurementSet set = read(std::string(kShort) +
                                  "S1,rigid,modulus,2e9\n"
                                  "S2,rigid,modulus,\"2e9\n"
                                  "S3,rigid,bending,2e9\n"
                                  "S4,rigid,modulus\n"
                                  "\n"
                                  "S5,rigid,modulus,2.1e9\n");
  ASSERT_EQ(set.specimens.size(), 2u);
  EXPECT_EQ(set.specimens[1].specimen, "S5");
  ASSERT_EQ(set.rejected.size(), 3u);
  EXPECT_EQ(set.rejected[0].line, 3);
  EXPECT_EQ(set.rejected[0].column, "modulus_pa");
  EXPECT_EQ(set.rejected[1].line, 4);
  EXPECT_EQ(set.rejected[1].column, "test");
  EXPECT_EQ(set.rejected[2].line, 5);
}

TEST_F(SetOnDisk, ValuesOutOfRangeAreRejectedWithTheirColumn) {
  const std::string header =
      "specimen,pattern,test,modulus_pa,orientation_deg,strain_rate_per_s,thickness_mm,print_order,valid";
  const struct {
    const char* row;
    const char* column;
    const char* expected;
  } cases[] = {
      {",rigid,modulus,2e9,,,,,", "specimen", "unique name"},
      {"S,purple,modulus,2e9,,,,,", "pattern", "mix:F"},
      {"S,mix:1.5,modulus,2e9,,,,,", "pattern", ""},
      {"S,,modulus,2e9,,,,,", "pattern", "empty"},
      {"S,rigid,modulus,-2e9,,,,,", "modulus_pa", "positive"},
      {"S,rigid,modulus,nan,,,,,", "modulus_pa", "finite"},
      {"S,rigid,modulus,,,,,,", "modulus_pa", "expected modulus_pa"},
      {"S,rigid,modulus,2e9,45,,,,", "orientation_deg", "0 or 90"},
      {"S,rigid,modulus,2e9,,0,,,", "strain_rate_per_s", "positive"},
      {"S,rigid,modulus,2e9,,,3mm,,", "thickness_mm", "number"},
      {"S,rigid,modulus,2e9,,,,1.5,", "print_order", "whole number"},
      {"S,rigid,modulus,2e9,,,,,yes", "valid", "0, 1, true or false"},
      {"S,rigid,toughness,2e9,,,,,", "toughness_pa", "toughness_pa or a curve"},
      {"S,rigid,tensile,2e9,,,,,", "curve", "expected one"},
      {"S,rigid,modulus,2e9,,,,,,surplus", "", "9"},
  };
  for (const auto& item : cases) {
    const MeasurementSet set = read(header + "\n" + item.row + "\nGOOD,soft,modulus,1e6,,,,,\n");
    ASSERT_EQ(set.rejected.size(), 1u) << item.row;
    EXPECT_EQ(set.specimens.size(), 1u);
    EXPECT_EQ(set.rejected[0].line, 2);
    EXPECT_EQ(set.rejected[0].column, item.column) << item.row;
    EXPECT_THAT(set.rejected[0].reason, HasSubstr(item.expected)) << item.row;
  }
}

TEST_F(SetOnDisk, WhatNoMessageCouldHoldIsRejectedWithItsColumn) {
  const std::string header = "specimen,pattern,test,modulus_pa,strain_rate_per_s,thickness_mm";
  const std::string longest(kLongestName, 'n');
  EXPECT_EQ(rejected(header, longest + "n,rigid,modulus,2e9,,").column, "specimen");
  EXPECT_EQ(rejected(header, "two\abells,rigid,modulus,2e9,,").column, "specimen");
  EXPECT_EQ(rejected(header, "\"two\nlines\",rigid,modulus,2e9,,").column, "specimen");
  EXPECT_EQ(rejected(header, "S,rigid,modulus,2e9,0.9e-9,").column, "strain_rate_per_s");
  EXPECT_EQ(rejected(header, "S,rigid,modulus,2e9,1.1e5,").column, "strain_rate_per_s");
  EXPECT_EQ(rejected(header, "S,rigid,modulus,2e9,,0.9e-3").column, "thickness_mm");
  EXPECT_EQ(rejected(header, "S,rigid,modulus,2e9,,1001").column, "thickness_mm");
  EXPECT_EQ(rejected(header, "S,rigid,modulus,1.1e13,,").column, "modulus_pa");
  const MeasurementSet set = read(header + "\n" + longest + ",rigid,modulus,2e9,1e-9,1e3\n");
  EXPECT_TRUE(set.rejected.empty());
}

TEST_F(SetOnDisk, ValuesOfAnotherUnitAreWarnedAbout) {
  const MeasurementSet set = read(
      "specimen,pattern,test,modulus_pa,toughness_pa\n"
      "S1,rigid,modulus,0.4,\n\nS2,rigid,toughness,,1.1\nS3,rigid,modulus,1e4,\nS4,rigid,toughness,,10\n");
  EXPECT_EQ(set.lines, (std::vector<int>{2, 4, 5, 6}));
  ASSERT_EQ(set.warnings.size(), 2u);
  EXPECT_THAT(set.warnings[0], HasSubstr(":2: column modulus_pa: 0.4 Pa, expected 10000"));
  EXPECT_THAT(set.warnings[1], HasSubstr(":4: column toughness_pa: 1.1 Pa, expected 10 "));
  const MeasurementSet plausible = read_plausible_set(folder_);
  EXPECT_EQ(plausible.lines, (std::vector<int>{5, 6}));
  EXPECT_TRUE(plausible.warnings.empty());
  ASSERT_EQ(plausible.rejected.size(), 2u);
  EXPECT_EQ(plausible.rejected[0].line, 2);
  EXPECT_EQ(plausible.rejected[0].column, "modulus_pa");
  EXPECT_EQ(rejected("specimen,pattern,test,modulus_pa,toughness_pa", "S,rigid,toughness,,1.65e11").column,
            "toughness_pa");
}

TEST_F(SetOnDisk, AValueThatIsNotUsedCostsNoRow) {
  read("specimen,pattern,test,modulus_pa,toughness_pa\nS1,rigid,modulus,2e9,5\nS2,rigid,toughness,3,1e5\n");
  const MeasurementSet set = read_plausible_set(folder_);
  EXPECT_EQ(set.specimens.size(), 2u);
  EXPECT_TRUE(set.rejected.empty());
  ASSERT_EQ(set.warnings.size(), 2u);
  EXPECT_THAT(set.warnings[0], HasSubstr("toughness_pa: is not used in a modulus test"));
  EXPECT_THAT(set.warnings[1], HasSubstr("modulus_pa: is not used in a toughness test"));
}

TEST_F(SetOnDisk, IdenticalRepeatIsIgnoredAndADifferentOneIsAnError) {
  const MeasurementSet set =
      read(std::string(kShort) + "S1,rigid,modulus,2e9\nS1,mix:1,modulus,2000000000\nS1,rigid,modulus,3e9\n");
  ASSERT_EQ(set.specimens.size(), 1u);
  EXPECT_EQ(set.specimens[0].modulus_pa, 2e9);
  ASSERT_EQ(set.rejected.size(), 1u);
  EXPECT_EQ(set.rejected[0].line, 4);
  EXPECT_EQ(set.rejected[0].column, "specimen");
}

TEST_F(SetOnDisk, NothingUsableIsAnInputErrorThatNamesTheFirstFault) {
  EXPECT_THAT(error_of(std::string(kShort) + "S1,rigid,modulus,x\n"), HasSubstr("line 2: column modulus_pa"));
  EXPECT_THAT(error_of(kShort), HasSubstr("heading only"));
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of("specimen,pattern,test\nS1,rigid,modulus\n"), HasSubstr("modulus_pa, toughness_pa, curve"));
  EXPECT_THAT(error_of("pattern,test,modulus_pa\nrigid,modulus,1\n"), HasSubstr("`specimen` is missing"));
  EXPECT_THAT(error_of("specimen,pattern,test,curve,curve\n"), HasSubstr("occurs twice"));
  EXPECT_THROW(read_measurement_set(folder_ / "absent"), InputError);
}

TEST_F(SetOnDisk, FilesStayInsideTheSet) {
  write("inside/curve.csv", "strain,stress_pa\n0,0\n1,1\n2,2\n3,3\n4,0\n");
  const fs::path outside = folder_.string() + "-outside.csv";
  fs::copy_file(folder_ / "inside/curve.csv", outside);
  fs::create_symlink(outside, folder_ / "link.csv");
  fs::create_symlink(folder_ / "inside/curve.csv", folder_ / "good-link.csv");
  ASSERT_EQ(mkfifo((folder_ / "pipe.csv").c_str(), 0600), 0);
  const std::string header = "specimen,pattern,test,curve\n", good = "S0,rigid,toughness,good-link.csv\n";
  for (const std::string& bad : {"../" + outside.filename().string(), outside.string(), std::string("link.csv"),
                                 std::string("inside/../inside/curve.csv"), std::string("absent.csv"),
                                 std::string("inside"), std::string("pipe.csv")}) {
    const MeasurementSet set = read(header + good + "S1,rigid,toughness," + bad + "\n");
    EXPECT_EQ(set.specimens.size(), 1u) << bad;
    ASSERT_EQ(set.rejected.size(), 1u) << bad;
    EXPECT_EQ(set.rejected[0].column, "curve") << bad;
  }
  const MeasurementSet pattern =
      read(header + good + "S1,../" + outside.filename().string() + ",toughness,inside/curve.csv\n");
  ASSERT_EQ(pattern.rejected.size(), 1u);
  EXPECT_EQ(pattern.rejected[0].column, "pattern");
  fs::remove(outside);
}

TEST_F(SetOnDisk, BadCurvesAreRejectedWithPlaceInTheirFile) {
  const struct {
    const char* text;
    const char* expected;
  } cases[] = {{"", "is empty"},
               {"strain;stress_pa\n", "strain,stress_pa"},
               {"strain,stress_pa\n0,0\n1,1\n2,2\n3,3\n", "has 4 rows"},
               {"strain,stress_pa\n0,0\n1,nan\n2,2\n3,3\n4,4\n", "c.csv:3:3: column stress_pa"},
               {"strain,stress_pa\n0,0\n1\n2,2\n3,3\n4,4\n", "c.csv:3: column stress_pa: the cell is empty"},
               {"strain,stress_pa\n0,0\n-1,0\n2,2\n3,3\n4,4\n", "above -1"},
               {"strain,strain,stress_pa\n", "twice"},
               {"strain,stress_pa\n0,0\n101,0\n2,2\n3,3\n4,4\n", "c.csv:3: 0 Pa at strain 101"},
               {"strain,stress_pa\n0,0\n1,2e13\n2,2\n3,3\n4,4\n", "c.csv:3: "},
               {"strain,stress_pa\n0,0\n1,-1\n2,-2\n3,-3\n4,-4\n", "not positive"}};
  for (const auto& item : cases) {
    write("c.csv", item.text);
    const MeasurementSet set =
        read("specimen,pattern,test,modulus_pa,curve\nG,soft,modulus,1e6,\nS,rigid,toughness,,c.csv\n");
    ASSERT_EQ(set.rejected.size(), 1u) << item.text;
    EXPECT_THAT(set.rejected[0].reason, HasSubstr(item.expected)) << item.text;
  }
}

TEST_F(SetOnDisk, GivenToughnessFarFromTheAreaIsAWarningAndWins) {
  write("c.csv", "strain,stress_pa\n0,0\n0.1,1e5\n0.2,2e5\n0.3,3e5\n0.4,0\n");  // area 6e4
  const std::string header = "specimen,pattern,test,toughness_pa,curve\n";
  EXPECT_TRUE(read(header + "S,rigid,toughness,6.1e4,c.csv\n").warnings.empty());
  const MeasurementSet set = read(header + "S,rigid,toughness,6.2e4,c.csv\n");
  ASSERT_EQ(set.warnings.size(), 1u);
  EXPECT_THAT(set.warnings[0], HasSubstr(":2: column toughness_pa"));
  EXPECT_EQ(toughness_of(set.specimens[0]), 6.2e4);
}

TEST_F(SetOnDisk, WhatIsWrittenIsReadBack) {
  std::vector<SpecimenRecord> records = read_measurement_set(kSmallSet).specimens;
  records[0].specimen = "../odd name/ü";
  records[2].specimen = "a/b";
  records[6].specimen = "a_b";  // the same file name after cleaning
  records[1].modulus_pa = 1.0 / 3.0 * 1e9;
  write_measurement_set(folder_ / "set", records);
  const MeasurementSet set = read_measurement_set(folder_ / "set");
  EXPECT_TRUE(set.rejected.empty());
  EXPECT_EQ(set.specimens, records);
}

}  // namespace
}  // namespace nacre::measurement
