#include "store/run_record.hpp"

#include <unistd.h>

#include <gtest/gtest.h>

#include "../wire/samples.hpp"
#include "store/run_database.hpp"

namespace nacre::store {
namespace {

namespace fs = std::filesystem;

class RunRecordOfAFile : public testing::Test {
 protected:
  ~RunRecordOfAFile() override {
    for (const char* companion : {"", "-wal", "-shm"}) fs::remove(file_.string() + companion);
  }
  void project_answer(const std::string& request_id) {
    wire::SimulateResult result = wire::samples::result();
    result.request_id = request_id;
    database_.project("SIMULATED", wire::write(result));
  }
  fs::path file_ = fs::temp_directory_path() / fmt::format("nacre-run-record-{}.db", ::getpid());
  RunDatabase database_{file_};
};

TEST_F(RunRecordOfAFile, OnlyAnswersAboutMeasuredDesignsAreWhatTheModelSaysOfThem) {
  project_answer("analyser/r1/films");  // toughness alone: its modulus of 0 says nothing
  project_answer("validation_agent/r1/measured/0");
  EXPECT_TRUE(read_run_record(file_).rounds[1].simulated.empty());
  project_answer("analyser/r1/measured/0");
  EXPECT_EQ(read_run_record(file_).rounds[1].simulated.size(), 2u);
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
