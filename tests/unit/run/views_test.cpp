#include "run/run_schema.hpp"

#include <unistd.h>

#include <filesystem>

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "../wire/samples.hpp"
#include "optimize/pareto.hpp"
#include "run/run_database.hpp"
#include "wire/convert.hpp"

namespace nacre::run {
namespace {

namespace fs = std::filesystem;

/// A run.db as any SQLite tool sees it.
class ViewsOfARun : public testing::Test {
 protected:
  ~ViewsOfARun() override {
    for (const char* companion : {"", "-wal", "-shm"}) fs::remove(file_.string() + companion);
  }
  /// The rows of a query, cells separated by |.
  std::vector<std::string> rows(const std::string& sql) {
    SQLite::Database db(file_.string(), SQLite::OPEN_READONLY, 1000);
    SQLite::Statement query(db, sql);
    std::vector<std::string> all;
    while (query.executeStep()) {
      std::string row;
      for (int i = 0; i < query.getColumnCount(); ++i)
        row += (i > 0 ? "|" : "") + std::string(query.getColumn(i).isNull() ? "-" : query.getColumn(i).getText());
      all.push_back(row);
    }
    return all;
  }
  void measure(const std::string& name, const pattern::Pattern& pattern, tester::TestKind test, double value_pa,
               int round = 1) {
    wire::Measurement m = wire::samples::measurement();
    m.round = round;
    m.record.specimen = name;
    m.record.design = pattern;
    m.record.test = test;
    m.record.curve = {};
    m.record.modulus_pa = test == tester::TestKind::modulus ? std::optional(value_pa) : std::nullopt;
    m.record.toughness_pa = test == tester::TestKind::toughness ? std::optional(value_pa) : std::nullopt;
    database_.keep("MEASUREMENT", wire::write(m));
  }
  void review(const std::string& specimen, int revision, bool valid) {
    wire::Review review;
    review.specimen = specimen;
    review.revision = revision;
    review.valid = valid;
    review.by = "Ada";
    review.why = valid ? "sound after all" : "slipped";
    database_.keep("REVIEW", wire::write(review));
  }
  void close(int round, bool last = false) {
    wire::RoundSummary summary = wire::samples::round();
    summary.round = round;
    summary.last = last;
    database_.keep("ROUND", wire::write(summary));
  }

  const pattern::Pattern a_{0x577fffe9fffdef}, b_{0x3ffc9b4ad4d2d9};
  fs::path file_ = fs::temp_directory_path() / fmt::format("nacre-views-{}.db", ::getpid());
  RunDatabase database_{file_};
};

TEST_F(ViewsOfARun, EveryViewAnswersAboutEveryMessage) {
  for (const char* view : {"rounds", "specimens", "designs", "gamut", "fronts", "effects"})
    EXPECT_TRUE(rows(fmt::format("SELECT * FROM {}", view)).empty()) << view;
  for (const auto& [channel, payload] : wire::samples::payloads()) database_.keep(channel, payload);
  for (const char* view : {"rounds", "specimens", "designs", "gamut", "fronts", "effects"})
    EXPECT_FALSE(rows(fmt::format("SELECT * FROM {}", view)).empty()) << view;
}

TEST_F(ViewsOfARun, TheLastWordOnARoundStands) {
  close(1);
  close(1, true);
  close(1);
  EXPECT_EQ(rows("SELECT round, last FROM rounds"), std::vector<std::string>{"1|1"});
}

TEST_F(ViewsOfARun, TheFirstReportOfASpecimenCountsAndItsHighestReview) {
  measure("s", a_, tester::TestKind::modulus, 1e9);
  measure("s", a_, tester::TestKind::modulus, 2e9);
  const std::string query = "SELECT modulus_pa, valid, reviewed_by FROM specimens";
  EXPECT_EQ(rows(query), std::vector<std::string>{"1000000000.0|1|-"});
  review("s", 2, false);
  review("s", 2, true);
  review("s", 1, true);
  EXPECT_EQ(rows(query), std::vector<std::string>{"1000000000.0|0|Ada"});
}

TEST_F(ViewsOfARun, TheNewestAmendmentOfASpecimenCountsInTheRoundOfTheFirstReport) {
  measure("s", a_, tester::TestKind::modulus, 1e8);
  close(1);
  wire::Measurement m = wire::samples::measurement();
  m.round = -1;
  m.record.specimen = "s";
  m.record.design = b_;
  m.record.test = tester::TestKind::modulus;
  m.record.curve = {};
  m.record.toughness_pa.reset();
  m.by = "Ada";
  m.why = "decimal point";
  for (const auto& [revision, modulus_pa] : {std::pair{2, 1e9}, std::pair{1, 5e9}}) {
    m.revision = revision;
    m.record.modulus_pa = modulus_pa;
    database_.keep("MEASUREMENT", wire::write(m));
  }
  EXPECT_EQ(rows("SELECT design, round, modulus_pa, revision, amended_by, amended_why FROM specimens"),
            std::vector<std::string>{"3ffc9b4ad4d2d9|1|1000000000.0|2|Ada|decimal point"});
  EXPECT_EQ(rows("SELECT design, modulus_pa FROM designs"), std::vector<std::string>{"3ffc9b4ad4d2d9|1000000000.0"});
  EXPECT_EQ(rows("SELECT count(*) FROM messages WHERE channel = 'MEASUREMENT'"), std::vector<std::string>{"3"})
      << "what was reported before is kept";
}

TEST_F(ViewsOfARun, ACurveIsReadForWhatItShows) {
  wire::Measurement m = wire::samples::measurement();
  m.record.toughness_pa.reset();
  database_.keep("MEASUREMENT", wire::write(m));
  EXPECT_EQ(rows("SELECT round(toughness_pa) FROM specimens"),
            std::vector<std::string>{fmt::format("{:.1f}", std::round(tester::area_under(m.record.curve)))});
}

TEST_F(ViewsOfARun, ADesignHasTheMeansOfItsValidSpecimens) {
  measure("1", a_, tester::TestKind::modulus, 1e9);
  measure("2", a_, tester::TestKind::modulus, 3e9);
  measure("3", a_, tester::TestKind::modulus, 9e9);
  measure("4", a_, tester::TestKind::toughness, 4e5, 2);
  review("3", 1, false);
  EXPECT_EQ(rows("SELECT design, measured_in, specimens, modulus_pa, toughness_pa FROM designs"),
            std::vector<std::string>{"577fffe9fffdef|1|3|2000000000.0|400000.0"});
}

TEST_F(ViewsOfARun, AFrontIsWhatNothingDominates) {
  wire::GamutChunk chunk = wire::samples::gamut();
  chunk.samples.clear();
  std::vector<optimize::Performance> points;
  for (std::uint64_t i = 1; i <= 300; ++i) {
    points.push_back({1e9 + 1e6 * static_cast<double>(i * 37 % 101), 1e5 + 1e3 * static_cast<double>(i * 53 % 97)});
    chunk.samples.push_back({pattern::Pattern(i), points.back()});
  }
  database_.keep("GAMUT", wire::write(chunk));
  EXPECT_EQ(rows("SELECT * FROM fronts").size(), optimize::pareto_front(points).size());
}

TEST_F(ViewsOfARun, AGamutIsPutTogetherFromItsBases) {
  const auto keep = [&](int round, int base, int total, std::vector<explore::Evaluated> samples) {
    database_.keep("GAMUT", wire::write(wire::GamutChunk{
                                .round = round, .base = base, .total = total, .samples = std::move(samples)}));
  };
  keep(0, -1, 2, {{pattern::Pattern(1), {1e9, 1e5}}, {pattern::Pattern(2), {2e9, 1e4}}});
  keep(1, 0, 3, {{pattern::Pattern(3), {3e9, 1e3}}});
  keep(2, 1, 3, {{pattern::Pattern(1), {1e9, 2e5}}});
  keep(3, -1, 1, {{pattern::Pattern(1), {5e9, 2e5}}});
  EXPECT_EQ(
      rows("SELECT round, pattern, modulus_pa / 1e9, toughness_pa FROM gamut WHERE pattern LIKE '%1' OR round = 2"),
      (std::vector<std::string>{"0|00000000000001|1.0|100000.0", "1|00000000000001|1.0|100000.0",
                                "2|00000000000001|1.0|200000.0", "2|00000000000002|2.0|10000.0",
                                "2|00000000000003|3.0|1000.0", "3|00000000000001|5.0|200000.0"}));
}

TEST_F(ViewsOfARun, TheMeasuredFrontGrowsFromRoundToRound) {
  close(1);
  close(2);
  for (const auto& [pattern, round] : {std::pair(a_, 1), std::pair(b_, 2)}) {
    measure(pattern.key() + "E", pattern, tester::TestKind::modulus, round == 1 ? 1e9 : 2e9, round);
    measure(pattern.key() + "T", pattern, tester::TestKind::toughness, round == 1 ? 4e5 : 2e5, round);
  }
  EXPECT_EQ(rows("SELECT round, design FROM fronts WHERE kind = 'measured'"),
            (std::vector<std::string>{"1|577fffe9fffdef", "2|3ffc9b4ad4d2d9", "2|577fffe9fffdef"}));
}

TEST_F(ViewsOfARun, MessagesCanBeAskedForAnyField) {
  for (const auto& [channel, payload] : wire::samples::payloads()) database_.keep(channel, payload);
  EXPECT_EQ(rows("SELECT content->>'$.parameters.modulus[0]' FROM messages WHERE channel = 'PARAMETERS'").size(), 1u);
  EXPECT_EQ(rows("SELECT length(hash) FROM messages GROUP BY 1"), std::vector<std::string>{"32"});
  EXPECT_TRUE(rows("SELECT 1 FROM messages WHERE content LIKE '%\"strain\"%'").empty()) << "curves stand in payloads";
}

}  // namespace
}  // namespace nacre::run
