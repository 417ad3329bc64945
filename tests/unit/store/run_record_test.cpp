#include "store/run_record.hpp"

#include <unistd.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "../wire/samples.hpp"
#include "store/misfit.hpp"
#include "store/run_database.hpp"

namespace nacre::store {
namespace {

namespace fs = std::filesystem;

class RunRecordOfAFile : public testing::Test {
 protected:
  ~RunRecordOfAFile() override {
    for (const char* companion : {"", "-wal", "-shm"}) fs::remove(file_.string() + companion);
  }
  void project_response(const std::string& request_id) {
    wire::SimulateResult result = wire::samples::result();
    result.request_id = request_id;
    database_.project("SIMULATED", wire::write(result));
  }
  fs::path file_ = fs::temp_directory_path() / fmt::format("nacre-run-record-{}.db", ::getpid());
  RunDatabase database_{file_};
};

TEST_F(RunRecordOfAFile, OnlyResponsesAboutMeasuredDesignsAreKeptAsThem) {
  project_response("analyser/r1/films");  // toughness alone: its modulus of 0 says nothing
  project_response("validation_agent/r1/measured/0");
  EXPECT_TRUE(read_run_record(file_).rounds[1].simulated.empty());
  project_response("analyser/r1/measured/0");
  EXPECT_EQ(read_run_record(file_).rounds[1].simulated.size(), 2u);
  project_response("analyser/r2/films#0123456789abcdef");
  EXPECT_TRUE(read_run_record(file_).rounds[2].simulated.empty());
  project_response("analyser/r2/measured/64#0123456789abcdef");
  EXPECT_EQ(read_run_record(file_).rounds[2].simulated.size(), 2u) << "runs before ids ended in a hash are read, too";
}

TEST_F(RunRecordOfAFile, TheFitOfACalibrationIsKeptAndSpeaksAgainstAVerdictThatFindsNothing) {
  wire::AdoptedModel model = wire::samples::model();
  model.provenance.modulus_fit = {
      .count = 12, .freedom = 8, .chi_squared = 1223.4, .chi_squared_replicates = 1500.0, .p_value = 1e-9};
  database_.project("PARAMETERS", wire::write(model));
  RoundRecord round = read_run_record(file_).rounds[model.round];
  EXPECT_EQ(round.modulus_fit, model.provenance.modulus_fit);
  EXPECT_EQ(round.toughness_fit, model.provenance.toughness_fit);
  EXPECT_EQ(misfit_beside_verdict(round), "") << "no diagnosis yet";
  round.diagnosis.emplace().verdict = "base_sufficient";
  EXPECT_NE(misfit_beside_verdict(round).find("E (chi squared 1223 at 8 degrees of freedom)"), std::string::npos);
  round.diagnosis->verdict = "unexplained";
  EXPECT_EQ(misfit_beside_verdict(round), "") << "the two agree";
  round.diagnosis->verdict = "base_sufficient";
  round.modulus_fit.p_value = 0.2;
  EXPECT_EQ(misfit_beside_verdict(round), "");
}

TEST_F(RunRecordOfAFile, AFileOfAVersionBeforeFitsIsRead) {
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("DROP TABLE goodness_of_fit");
  EXPECT_TRUE(read_run_record(file_).rounds.empty());
}

TEST_F(RunRecordOfAFile, CracksBelongToTheRoundOrTheFamilyWhoseModelBrokeThem) {
  const wire::CalibratedFamily family = wire::samples::family();
  database_.project("FAMILY", wire::write(family));
  wire::Fracture fracture = wire::samples::fracture();
  for (const std::string& request_id :
       {fmt::format("analyser/family{}/films", family.number), std::string("analyser/r7/films#0123456789abcdef")}) {
    fracture.request_id = request_id;
    database_.project("FRACTURE", wire::write(fracture));
  }
  RunRecord run = read_run_record(file_);
  const std::string design = fracture.design.name();
  ASSERT_EQ(run.families.size(), 1u);
  ASSERT_TRUE(run.families[0].cracks.contains(design));
  EXPECT_EQ(run.families[0].cracks[design].film, fracture.film);
  EXPECT_EQ(run.families[0].cracks[design].crack.path, fracture.crack.path);
  ASSERT_TRUE(run.rounds[7].cracks.contains(design));
  EXPECT_EQ(run.rounds[7].cracks.size(), 1u);
  EXPECT_FALSE(run.rounds.contains(family.number));
}

TEST_F(RunRecordOfAFile, VariantsWaitForTheWordOnTheirFamily) {
  wire::FamilyGamut gamut = wire::samples::family_gamut();
  gamut.number = wire::samples::family().number;
  database_.project("FAMILY_GAMUT", wire::write(gamut));
  EXPECT_TRUE(read_run_record(file_).families.empty());
  database_.project("FAMILY", wire::write(wire::samples::family()));
  ASSERT_EQ(read_run_record(file_).families.size(), 1u);
  EXPECT_EQ(read_run_record(file_).families[0].gamut.size(), gamut.samples.size());
}

TEST_F(RunRecordOfAFile, FamiliesAreKeptInAFileOfAVersionBeforeThem) {
  {
    SQLite::Database before(file_.string(), SQLite::OPEN_READWRITE);
    for (const char* table : {"family", "family_parameter", "family_design", "family_gamut", "family_crack"})
      before.exec(std::string("DROP TABLE ") + table);
  }
  EXPECT_TRUE(read_run_record(file_).families.empty());
  RunDatabase(file_).project("FAMILY", wire::write(wire::samples::family()));
  EXPECT_EQ(read_run_record(file_).families.size(), 1u);
}

TEST_F(RunRecordOfAFile, AReviewBringsBackASpecimenThatMeansSomethingAndNoOther) {
  wire::Measurement measurement = wire::samples::measurement();
  measurement.record.test = tester::TestKind::modulus;
  measurement.record.curve = {};
  measurement.record.toughness_pa = std::nullopt;
  measurement.record.valid = false;
  const auto project = [&](const std::string& name, double modulus_pa) {
    measurement.record.specimen = name;
    measurement.record.modulus_pa = modulus_pa;
    database_.project("MEASUREMENT", wire::write(measurement));
    wire::Review review;
    review.specimen = name;
    review.revision = 1;
    review.valid = true;
    database_.project("REVIEW", wire::write(review));
  };
  project("a", 1.2e9);
  project("b", 1.2);  // typed in GPa
  const auto specimens = read_run_record(file_).specimens;
  ASSERT_EQ(specimens.size(), 2u);
  EXPECT_TRUE(specimens[0].record.valid);
  EXPECT_FALSE(specimens[1].record.valid);
}

TEST_F(RunRecordOfAFile, AGamutIsReadWithItsPatternsOrLeftOut) {
  wire::GamutChunk chunk{
      .round = 3, .samples = {{pattern::Pattern(0x577fffe9fffdef), {1e9, 1e5}}, {pattern::Pattern(1), {2e9, 5e4}}}};
  database_.project("GAMUT", wire::write(chunk));
  EXPECT_EQ(read_run_record(file_).rounds[3].gamut.size(), 2u);
  EXPECT_TRUE(read_run_record(file_, false).rounds[3].gamut.empty());
  EXPECT_EQ(read_gamut_sizes(file_), (std::map<int, int>{{3, 2}}));
  const RecordedGamut gamut = read_gamut(file_, 3);
  EXPECT_EQ(gamut.patterns, (std::vector<std::uint64_t>{1, 0x577fffe9fffdef}));
  EXPECT_EQ(gamut.performances.front(), (optimize::Performance{2e9, 5e4}));
  EXPECT_TRUE(read_gamut(file_, 4).patterns.empty());
}

}  // namespace
}  // namespace nacre::store
