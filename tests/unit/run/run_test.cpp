#include "run/run.hpp"

#include <unistd.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "../wire/samples.hpp"
#include "base/result.hpp"
#include "run/misfit.hpp"
#include "run/run_database.hpp"

namespace nacre::run {
namespace {

namespace fs = std::filesystem;

class RunOfAFile : public testing::Test {
 protected:
  RunOfAFile() {
    fs::create_directories(folder_);
    database_.emplace(file_);
  }
  ~RunOfAFile() override { fs::remove_all(folder_); }
  RunRecord read() { return run_.record_with_gamuts(); }
  void project_response(const std::string& request_id) {
    wire::SimulateResult result = wire::samples::result();
    result.request_id = request_id;
    database_->keep("SIMULATED", wire::write(result));
  }
  fs::path folder_ = fs::temp_directory_path() / fmt::format("nacre-run-{}", ::getpid());
  fs::path file_ = folder_ / "run.db";
  std::optional<RunDatabase> database_;
  run::Run run_{folder_};
};

TEST_F(RunOfAFile, OnlyResponsesAboutMeasuredDesignsAreKeptAsThem) {
  project_response("analyser/r1/films");  // toughness alone: its modulus of 0 says nothing
  project_response("validation_agent/r1/measured/0");
  EXPECT_TRUE(read().rounds[1].simulated.empty());
  project_response("analyser/r1/measured/0");
  EXPECT_EQ(read().rounds[1].simulated.size(), 2u);
  project_response("analyser/r2/films#0123456789abcdef");
  EXPECT_TRUE(read().rounds[2].simulated.empty());
  project_response("analyser/r2/measured/64#0123456789abcdef");
  EXPECT_EQ(read().rounds[2].simulated.size(), 2u) << "runs before ids ended in a hash are read, too";
}

TEST_F(RunOfAFile, TheFitOfACalibrationIsKeptAndSpeaksAgainstAVerdictThatFindsNothing) {
  wire::AdoptedModel model = wire::samples::model();
  model.provenance.modulus_fit = {
      .count = 12, .freedom = 8, .chi_squared = 1223.4, .chi_squared_replicates = 1500.0, .p_value = 1e-9};
  database_->keep("PARAMETERS", wire::write(model));
  RoundRecord round = read().rounds[model.round];
  EXPECT_EQ(round.model, model);
  EXPECT_EQ(misfit_beside_verdict(round), "") << "no diagnosis yet";
  round.diagnosis.emplace().verdict = "base_sufficient";
  EXPECT_NE(misfit_beside_verdict(round).find("E (chi squared 1223 at 8 degrees of freedom)"), std::string::npos);
  round.diagnosis->verdict = "unexplained";
  EXPECT_EQ(misfit_beside_verdict(round), "") << "the two agree";
  round.diagnosis->verdict = "base_sufficient";
  round.model->provenance.modulus_fit.p_value = 0.2;
  EXPECT_EQ(misfit_beside_verdict(round), "");
}

TEST_F(RunOfAFile, CracksBelongToTheRoundOrTheFamilyWhoseModelBrokeThem) {
  const wire::CalibratedFamily family = wire::samples::family();
  database_->keep("FAMILY", wire::write(family));
  wire::Fracture fracture = wire::samples::fracture();
  for (const std::string& request_id :
       {fmt::format("analyser/family{}/films", family.number), std::string("analyser/r7/films#0123456789abcdef")}) {
    fracture.request_id = request_id;
    database_->keep("FRACTURE", wire::write(fracture));
  }
  RunRecord run = read();
  const std::string design = fracture.design.name();
  ASSERT_EQ(run.families.size(), 1u);
  ASSERT_TRUE(run.families[0].cracks.contains(design));
  EXPECT_EQ(run.families[0].cracks[design].film, fracture.film);
  EXPECT_EQ(run.families[0].cracks[design].crack.path, fracture.crack.path);
  ASSERT_TRUE(run.rounds[7].cracks.contains(design));
  EXPECT_EQ(run.rounds[7].cracks.size(), 1u);
  EXPECT_FALSE(run.rounds.contains(family.number));
}

TEST_F(RunOfAFile, VariantsWaitForTheWordOnTheirFamily) {
  wire::FamilyGamut gamut = wire::samples::family_gamut();
  gamut.number = wire::samples::family().number;
  database_->keep("FAMILY_GAMUT", wire::write(gamut));
  EXPECT_TRUE(read().families.empty());
  database_->keep("FAMILY", wire::write(wire::samples::family()));
  ASSERT_EQ(read().families.size(), 1u);
  EXPECT_EQ(read().families[0].gamut->patterns.size(), gamut.samples.size());
}

TEST_F(RunOfAFile, AReviewBringsBackASpecimenThatMeansSomethingAndNoOther) {
  wire::Measurement measurement = wire::samples::measurement();
  measurement.record.test = tester::TestKind::modulus;
  measurement.record.curve = {};
  measurement.record.toughness_pa = std::nullopt;
  measurement.record.valid = false;
  const auto project = [&](const std::string& name, double modulus_pa) {
    measurement.record.specimen = name;
    measurement.record.modulus_pa = modulus_pa;
    database_->keep("MEASUREMENT", wire::write(measurement));
    wire::Review review;
    review.specimen = name;
    review.revision = 1;
    review.valid = true;
    database_->keep("REVIEW", wire::write(review));
  };
  project("a", 1.2e9);
  project("b", 1.2);  // typed in GPa
  const auto specimens = read().specimens;
  ASSERT_EQ(specimens.size(), 2u);
  EXPECT_TRUE(specimens[0].record.valid);
  EXPECT_FALSE(specimens[1].record.valid);
}

TEST_F(RunOfAFile, AGamutIsReadWithItsPatternsOrLeftOut) {
  wire::GamutChunk chunk{
      .round = 3,
      .total = 2,
      .samples = {{pattern::Pattern(0x577fffe9fffdef), {1e9, 1e5}}, {pattern::Pattern(1), {2e9, 5e4}}}};
  database_->keep("GAMUT", wire::write(chunk));
  EXPECT_EQ(read().rounds[3].gamut->patterns.size(), 2u);
  EXPECT_EQ(run_.record()->rounds.at(3).gamut, nullptr);
  EXPECT_EQ(run_.record()->rounds.at(3).gamut_count, 2);
  const auto gamut = run_.gamut(3);
  EXPECT_EQ(gamut->patterns, (std::vector<std::uint64_t>{1, 0x577fffe9fffdef}));
  EXPECT_EQ(gamut->performances.front(), (optimize::Performance{2e9, 5e4}));
  EXPECT_EQ(run_.gamut(3), gamut) << "it is kept";
  EXPECT_TRUE(run_.gamut(4)->patterns.empty());
}

TEST_F(RunOfAFile, AGrowingRunIsReadOnFromWhereItWasRead) {
  wire::GamutChunk chunk = wire::samples::gamut();
  chunk.chunks = 2;
  chunk.total = 3;
  database_->keep("GAMUT", wire::write(chunk));
  EXPECT_EQ(run_.gamut(chunk.round)->patterns.size(), 2u);
  const std::string before = run_.version();
  chunk.chunk = 1;
  chunk.samples = {{pattern::Pattern(1), {2e9, 5e4}}};
  database_->keep("GAMUT", wire::write(chunk));
  EXPECT_NE(run_.version(), before);
  EXPECT_EQ(run_.gamut(chunk.round)->patterns.size(), 3u);
  EXPECT_EQ(run_.record()->rounds.at(chunk.round).gamut_count, 3);
}

TEST_F(RunOfAFile, AGamutIsPutTogetherFromItsBases) {
  const auto keep = [&](int round, int base, int total, std::vector<explore::Evaluated> samples) {
    database_->keep("GAMUT", wire::write(wire::GamutChunk{
                                 .round = round, .base = base, .total = total, .samples = std::move(samples)}));
  };
  keep(5, 4, 3, {{pattern::Pattern(1), {2e9, 9e4}}});
  keep(4, 3, 3, {{pattern::Pattern(9), {3e9, 1e4}}});
  EXPECT_FALSE(run_.record()->rounds.at(5).is_gamut_whole) << "round 3 is on its way";
  keep(3, -1, 2, {{pattern::Pattern(7), {1e9, 1e5}}, {pattern::Pattern(1), {2e9, 5e4}}});
  const auto rounds = run_.record()->rounds;
  for (const int round : {3, 4, 5}) {
    EXPECT_TRUE(rounds.at(round).is_gamut_whole);
    EXPECT_EQ(rounds.at(round).gamut_count, round == 3 ? 2 : 3);
  }
  EXPECT_EQ(run_.gamut(4)->patterns, (std::vector<std::uint64_t>{1, 7, 9}));
  EXPECT_EQ(run_.gamut(4)->performances.front(), (optimize::Performance{2e9, 5e4}));
  EXPECT_EQ(run_.gamut(5)->performances.front(), (optimize::Performance{2e9, 9e4})) << "the later sample counts";
  EXPECT_EQ(run_.record_with_gamuts(std::set{5}).rounds.at(4).gamut, nullptr) << "nobody asked for it";
}

TEST_F(RunOfAFile, ADatabaseMadeAnewIsReadAnew) {
  database_->keep("ROUND", wire::write(wire::samples::round()));
  ASSERT_EQ(run_.record()->rounds.size(), 1u);
  database_.reset();
  fs::rename(file_, folder_ / "old.db");
  database_.emplace(file_);
  database_->keep("PROPOSAL", wire::write(wire::samples::proposal()));
  const auto record = run_.record();
  ASSERT_EQ(record->rounds.size(), 1u);
  EXPECT_FALSE(record->rounds.begin()->second.summary);
}

TEST_F(RunOfAFile, AMessageIsKeptOnceHoweverOftenItComes) {
  for (int turn = 0; turn < 3; ++turn)
    for (const auto& [channel, payload] : wire::samples::payloads()) database_->keep(channel, payload);
  for (const auto& [channel, payload] : wire::samples::payloads())
    EXPECT_EQ(run_.payloads(channel), std::vector<std::string>{payload}) << channel;
}

TEST_F(RunOfAFile, MessagesAreFoundByChannelAndRound) {
  wire::RoundSummary summary = wire::samples::round();
  for (summary.round = 0; summary.round < 3; ++summary.round) database_->keep("ROUND", wire::write(summary));
  EXPECT_EQ(run_.payloads("ROUND").size(), 3u);
  summary.round = 1;
  EXPECT_EQ(run_.payloads("ROUND", 1), std::vector<std::string>{wire::write(summary)});
  EXPECT_TRUE(run_.payloads("PROPOSAL", 1).empty());
}

TEST_F(RunOfAFile, TheNewestAmendmentCountsInTheRoundOfTheFirstReport) {
  wire::Measurement measurement = wire::samples::measurement();
  const auto report = [&](int revision, double toughness_pa) {
    measurement.revision = revision;
    measurement.by = measurement.why = revision > 0 ? "Ada" : "";
    measurement.record.toughness_pa = toughness_pa;
    database_->keep("MEASUREMENT", wire::write(measurement));
  };
  measurement.round = 1;
  report(0, 1e4);
  measurement.round = -1;
  wire::RoundSummary summary = wire::samples::round();
  summary.round = 3;
  database_->keep("ROUND", wire::write(summary));
  report(2, 1e5);
  report(1, 9e5);
  const auto specimens = run_.record()->specimens;
  ASSERT_EQ(specimens.size(), 1u);
  EXPECT_EQ(specimens[0].record.toughness_pa, 1e5);
  EXPECT_EQ(specimens[0].amendment.revision, 2);
  EXPECT_EQ(specimens[0].measured_in, 1);
}

TEST_F(RunOfAFile, LateSpecimensKeepTheRoundTheyWereMeasuredIn) {
  wire::Measurement measurement = wire::samples::measurement();
  wire::RoundSummary summary = wire::samples::round();
  measurement.round = -1;
  const auto measure = [&](const char* name) {
    measurement.record.specimen = name;
    database_->keep("MEASUREMENT", wire::write(measurement));
  };
  measure("a, before the game");
  for (summary.round = 0; summary.round <= 2; ++summary.round) {
    summary.last = summary.round == 2;
    database_->keep("ROUND", wire::write(summary));
    measure(summary.last ? "d, after the game" : summary.round == 0 ? "b, in round 1" : "c, in round 2");
  }
  std::vector<int> measured_in;
  const auto record = run_.record();
  for (const MeasuredSpecimen& specimen : record->specimens) measured_in.push_back(specimen.measured_in);
  EXPECT_EQ(measured_in, (std::vector<int>{0, 1, 2, 2}));
}

TEST_F(RunOfAFile, AnotherVersionIsRefusedWithTheRemedy) {
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 3");
  try {
    fs::last_write_time(file_, fs::last_write_time(file_) - std::chrono::hours(1));
    (void)run_.record();
    FAIL() << "expected a refusal";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("schema version 3"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("nacre rebuild"), std::string::npos);
  }
}

TEST_F(RunOfAFile, StrangersViewsTriggersAndComputedColumnsAreRefused) {
  for (const char* trap :
       {"CREATE VIEW message AS SELECT 1", "DROP TABLE messages; CREATE VIEW messages AS SELECT 1 AS id",
        "CREATE TRIGGER trap AFTER INSERT ON messages BEGIN DELETE FROM samples; END",
        "CREATE TABLE t(a, b AS (a || zeroblob(1000000)))"}) {
    database_.reset();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    database_.emplace(file_);
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(trap);
    EXPECT_THROW((void)run::Run(folder_).payloads("ROUND"), InputError) << trap;
  }
}

}  // namespace
}  // namespace nacre::run
