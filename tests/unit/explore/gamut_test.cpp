#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "explore/gamut_csv.hpp"
#include "explore/merge.hpp"
#include "synthetic.hpp"

namespace nacre::explore {
namespace {

using ::testing::HasSubstr;

std::vector<Evaluated> some_gamut(std::uint64_t seed) {
  const auto search =
      make_search({.algorithm = "nsga2", .budget = 100, .population = 20, .batch = 10, .seed = seed, .known = {}});
  run(*search);
  return search->evaluated();
}

std::string reading_error(std::string_view text) {
  try {
    gamut_from_csv(text, "gamut.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(GamutCsv, KeepsHowWellMeansAreKnown) {
  std::vector<Evaluated> gamut = some_gamut(1);
  gamut[2].sampling = {4, 1234.5};
  const std::string csv = to_csv(gamut);
  EXPECT_THAT(csv, HasSubstr("modulus_pa,toughness_pa,toughness_se_pa,specimens\n"));
  EXPECT_EQ(gamut_from_csv(csv, "gamut.csv"), gamut);
  const std::string head = "pattern,modulus_pa,toughness_pa,specimens\n577fffe9fffdef,1,1,";
  EXPECT_EQ(gamut_from_csv(head + "3\n", "g").front().sampling, (Sampling{3, 0.0}));
  EXPECT_THAT(reading_error(head + "0\n"), HasSubstr("line 2, column 4 (specimens): \"0\", expected a whole number"));
}

TEST(Changes, OfAGamutAndTheGamutTheyMakeOfItsBase) {
  const auto base = some_gamut(1);
  auto now = base;
  now[3].performance.toughness_pa *= 2.0;
  for (const Evaluated& sample : some_gamut(2)) now.push_back(sample);
  const std::vector<Evaluated> both[] = {now};
  now = merge_gamuts(both);
  const auto changed = changes(base, now);
  EXPECT_EQ(changed.size(), now.size() - base.size() + 1);
  EXPECT_EQ(with_changes(base, changed), now);
  EXPECT_TRUE(changes(now, now).empty());
  EXPECT_EQ(changes({}, now), now);
}

TEST(GamutCsv, ReadsBackExactlyWhatWasWritten) {
  const auto gamut = some_gamut(1);
  const std::string path = ::testing::TempDir() + "/nacre_gamut_test.csv";
  write_gamut_csv(path, gamut);
  EXPECT_EQ(read_gamut_csv(path), gamut);
  std::filesystem::remove(path);
  EXPECT_THAT(to_csv(gamut), HasSubstr("index,pattern,rigid_fraction,modulus_pa,toughness_pa\n0,"));
  EXPECT_TRUE(gamut_from_csv(to_csv({}), "gamut.csv").empty());
}

TEST(GamutCsv, AcceptsWhatSpreadsheetsWrite) {
  const auto gamut = gamut_from_csv(
      "\xef\xbb\xbf\"toughness_pa\",note,pattern,modulus_pa\r\n\"2.5e5\",hello,577fffe9fffdef,1.5e9\r\n\r\n1,,"
      "3ffc9b4ad4d2d9,2",
      "gamut.csv");
  ASSERT_EQ(gamut.size(), 2u);
  EXPECT_EQ(gamut[0].pattern.key(), "577fffe9fffdef");
  EXPECT_EQ(gamut[0].performance, (optimize::Performance{1.5e9, 2.5e5}));
  EXPECT_EQ(gamut[1].performance, (optimize::Performance{2.0, 1.0}));
}

TEST(GamutCsv, ErrorsNameFileLineColumnAndWhatWasExpected) {
  const std::string header = "index,pattern,rigid_fraction,modulus_pa,toughness_pa\n";
  const std::string row = "0,577fffe9fffdef,0.84,1e9,2e5\n";
  EXPECT_THAT(reading_error(""), HasSubstr("gamut.csv: line 1: the file is empty"));
  EXPECT_THAT(reading_error("index,pattern,modulus_pa\n"),
              HasSubstr("line 1: no column toughness_pa, expected index,pattern"));
  EXPECT_THAT(reading_error("pattern,modulus_pa,modulus_pa,toughness_pa\n"),
              HasSubstr("line 1, column 3: a second column"));
  EXPECT_THAT(reading_error(header + row + "1,3ffc9b4ad4d2d9,0.6,abc,2e5\n"),
              HasSubstr("gamut.csv: line 3, column 4 (modulus_pa): \"abc\", expected a finite number, not negative"));
  for (const char* bad : {"nan", "inf", "-1", "", "1e9x", "1e999"}) {
    EXPECT_THAT(reading_error(header + "1,3ffc9b4ad4d2d9,0.6,1e9," + bad + "\n"),
                HasSubstr("line 2, column 5 (toughness_pa)"));
  }
  EXPECT_THAT(reading_error(header + "1,3ffc9b4ad4d2d,0.6,1,2\n"), HasSubstr("line 2, column 2 (pattern)"));
  EXPECT_THAT(reading_error(header + "1,3ffc9b4ad4d2d9,0.6,1\n"),
              HasSubstr("line 2, column 5: the row has 4 fields, expected 5"));
  EXPECT_THAT(reading_error(header + row + row), HasSubstr("each pattern once: it stands in line 2 already"));
  EXPECT_THROW(read_gamut_csv("no/such/gamut.csv"), InputError);
}

TEST(Merge, KeepsEachPatternOnceInOrder) {
  auto first = some_gamut(1), second = some_gamut(2);
  second.insert(second.begin(), first[3]);
  const std::vector<std::vector<Evaluated>> all = {first, second, first};
  const auto merged = merge_gamuts(all);
  ASSERT_EQ(merged.size(), 200u);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), merged.begin()));
  EXPECT_TRUE(std::equal(second.begin() + 1, second.end(), merged.begin() + 100));
  EXPECT_TRUE(merge_gamuts({}).empty());
}

}  // namespace
}  // namespace nacre::explore
