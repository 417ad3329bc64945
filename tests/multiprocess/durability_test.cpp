// Databases and journals of a run: copied while it plays, damaged, lost, made anew.

#include <fstream>
#include <memory>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "game/scenario.hpp"
#include "played_game.hpp"
#include "processes.hpp"
#include "program_test.hpp"
#include "run/rebuild.hpp"
#include "run/run_schema.hpp"
#include "runtime/run_copy.hpp"
#include "runtime/run_folder.hpp"
#include "short_game.hpp"
#include "store/database_care.hpp"
#include "store/simulation_cache.hpp"

namespace nacre {
namespace {

using testing::AnyOf;

constexpr double kPatienceS = 240.0;
/// The whole content of a database as SQL.
std::string content(const fs::path& database) {
  SQLite::Database db(database.string(), SQLite::OPEN_READONLY, 10'000);
  SQLite::Statement tables(db, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
  std::string all;
  while (tables.executeStep()) {
    SQLite::Statement rows(db, fmt::format("SELECT * FROM {} ORDER BY 1, 2", tables.getColumn(0).getString()));
    while (rows.executeStep()) {
      all += tables.getColumn(0).getString();
      for (int i = 0; i < rows.getColumnCount(); ++i) {
        const SQLite::Column value = rows.getColumn(i);
        all += "|" + std::string(static_cast<const char*>(value.getBlob()), static_cast<std::size_t>(value.getBytes()));
      }
      all += "\n";
    }
  }
  return all;
}

/// One game is played while a backup is taken of it; everything else is done to copies.
class Durability : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("durability");
    std::ofstream(folder_ / "durable.toml") << short_game("durable", 1);
    game_ = std::make_unique<PlayedGame>(folder_ / "durable.toml", folder_ / "logs", "game");
    game_->play_until([] { return journal_bytes(game_->folder(), "validation_agent") > 20'000; }, kPatienceS);
    is_playing_at_backup_ = !game_->is_over();
    // A farm with a device keeps a cache of its own.
    store::SimulationCache(folder_ / "logs" / "simulations-cuda.db").insert("key", {});
    backup_ = run_nacre({"backup", "--run", game_->folder().string(), "--to", (folder_ / "backup").string(), "--json"});
    std::error_code no_backup;  // which the tests say
    fs::copy_file(journal_of(folder_ / "backup" / "game", "validation_agent"), folder_ / "early.lcm", no_backup);
    game_->play_to_end(kPatienceS);
  }
  static void TearDownTestSuite() { game_.reset(); }
  void SetUp() override {
    ASSERT_EQ(game_->status(), 0) << game_->said();
    copy_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name()) / "game";
    fs::copy(game_->folder(), copy_, fs::copy_options::recursive);
  }

  static fs::path folder_;
  static std::unique_ptr<PlayedGame> game_;
  static Outcome backup_;
  static bool is_playing_at_backup_;
  fs::path copy_;
};

fs::path Durability::folder_;
std::unique_ptr<PlayedGame> Durability::game_;
Outcome Durability::backup_;
bool Durability::is_playing_at_backup_ = false;

TEST_F(Durability, ABackupOfAPlayingGamePlaysOnToTheSameEnd) {
  EXPECT_TRUE(is_playing_at_backup_);
  ASSERT_EQ(backup_.status, 0) << backup_.err;
  const auto said = nlohmann::json::parse(backup_.out);
  EXPECT_EQ(said["journals"], 5);
  const fs::path run = folder_ / "backup" / "game";
  EXPECT_TRUE(store::check_database(run / "run.db"));
  EXPECT_TRUE(store::check_database(folder_ / "backup" / "simulations.db"));
  EXPECT_EQ(store::SimulationCache(folder_ / "backup" / "simulations-cuda.db").size(), 1);
  PlayedGame resumed(run);
  ASSERT_TRUE(resumed.play_to_end(kPatienceS)) << resumed.said();
  ASSERT_EQ(resumed.status(), 0) << resumed.said();
  EXPECT_THAT(differences(sent_in_game(game_->folder()), sent_in_game(run)), IsEmpty());
  EXPECT_EQ(content(run / "run.db"), content(game_->folder() / "run.db"));
}

TEST_F(Durability, AJournalOfABackupTakesThePlaceOfOneThatIsLost) {
  const fs::path journal = journal_of(copy_, "validation_agent");
  const auto whole = fs::file_size(journal);
  fs::copy_file(folder_ / "early.lcm", journal, fs::copy_options::overwrite_existing);
  ASSERT_LT(fs::file_size(journal), whole);
  PlayedGame resumed(copy_);
  ASSERT_TRUE(resumed.play_to_end(kPatienceS)) << resumed.said();
  ASSERT_EQ(resumed.status(), 0) << resumed.said();
  EXPECT_THAT(differences(sent_in_game(game_->folder()), sent_in_game(copy_)), IsEmpty());
}

TEST_F(Durability, ABackupNeedsANewFolder) {
  const Outcome again = run_nacre({"backup", "--run", game_->folder().string(), "--to", (folder_ / "backup").string()});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("exists already"));
}

TEST_F(Durability, TheDatabaseIsAProjectionOfTheJournal) {
  const std::string before = content(copy_ / "run.db");
  ASSERT_GT(before.size(), 1000U);
  fs::remove(copy_ / "run.db");
  const Outcome rebuilt = run_nacre({"rebuild", "--run", copy_.string()});
  ASSERT_EQ(rebuilt.status, 0) << rebuilt.err;
  EXPECT_EQ(content(copy_ / "run.db"), before);
  ASSERT_EQ(run_nacre({"rebuild", "--run", copy_.string()}).status, 0);
  EXPECT_EQ(content(copy_ / "run.db"), before);
  EXPECT_FALSE(fs::exists(copy_ / "run.db.damaged")) << "a whole one is not kept beside its equal";
}

TEST_F(Durability, ADatabaseFromATornJournalSaysSoAndOneFromNoneLeavesEverything) {
  const fs::path journal = copy_ / "nodes" / "analyser" / "journal.lcm";
  fs::resize_file(journal, fs::file_size(journal) - 3);
  const Outcome torn = run_nacre({"rebuild", "--run", copy_.string(), "--json"});
  ASSERT_EQ(torn.status, 0) << torn.err;
  EXPECT_GT(nlohmann::json::parse(torn.out)["torn_bytes"], 0);
  EXPECT_THAT(torn.err, HasSubstr("torn record"));
  EXPECT_TRUE(fs::exists(copy_ / "run.db.damaged")) << "it may hold what the journal has lost";
  const std::string before = content(copy_ / "run.db");
  fs::remove(journal);
  EXPECT_EQ(run_nacre({"rebuild", "--run", copy_.string()}).status, 2);
  EXPECT_EQ(content(copy_ / "run.db"), before);
  EXPECT_FALSE(fs::exists(copy_ / "run.db.part"));
}

TEST_F(Durability, ADamagedDatabaseIsSaidAndMadeAnewWhenTheAnalyserStarts) {
  const std::string before = content(copy_ / "run.db");
  {
    std::fstream bytes(copy_ / "run.db", std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(6000);
    bytes << std::string(8000, '\x5a');
  }
  ASSERT_FALSE(store::check_database(copy_ / "run.db"));
  std::string said;
  {
    const auto database = run::open_run_database(copy_, [&](const std::string& text) { said += text; });
  }
  EXPECT_THAT(said, AllOf(HasSubstr("run.db: is damaged"), HasSubstr("made anew")));
  EXPECT_TRUE(store::check_database(copy_ / "run.db"));
  EXPECT_EQ(content(copy_ / "run.db"), before);
  EXPECT_TRUE(fs::exists(copy_ / "run.db.damaged"));
}

TEST_F(Durability, ADatabaseOfAnotherVersionIsMigratedByMakingItAnew) {
  const std::string before = content(copy_ / "run.db");
  SQLite::Database(((copy_ / "run.db").string()), SQLite::OPEN_READWRITE)
      .exec("DROP TABLE samples; PRAGMA user_version = 1");
  std::string said;
  {
    const auto database = run::open_run_database(copy_, [&](const std::string& text) { said += text; });
  }
  EXPECT_THAT(said, HasSubstr("schema version 1"));
  EXPECT_EQ(store::schema_version(copy_ / "run.db"), run::kRunSchemaVersion);
  EXPECT_EQ(content(copy_ / "run.db"), before);
}

TEST_F(Durability, AWholeDatabaseIsLeftAlone) {
  const auto written = fs::last_write_time(copy_ / "run.db");
  bool is_silent = true;
  {
    const auto database = run::open_run_database(copy_, [&](const std::string&) { is_silent = false; });
  }
  EXPECT_TRUE(is_silent);
  EXPECT_EQ(fs::last_write_time(copy_ / "run.db"), written);
}

// Exit status 1: the launcher starts it again, and by then there may be room.
TEST(FullDisk, AtTheirFirstStartNoNodeTakesItForBadInput) {
  const fs::path folder = fresh_folder("full_disk"), disk = folder / "disk", errors = folder / "errors";
  fs::create_directories(disk);
  if (!test::isolated() ||
      test::Process({"mount", "-t", "tmpfs", "-o", "size=512k", "nacre-test", disk.string()}, errors).wait(5) != 0)
    GTEST_SKIP() << "no file system can be mounted here";
  std::ofstream(folder / "full.toml") << short_game("full", 1);
  const fs::path run =
      runtime::RunFolder::create(disk / "logs", "game", game::read_scenario(folder / "full.toml")).path();
  std::ofstream ballast(disk / "ballast");
  while (ballast << std::string(4096, 'x') << std::flush) continue;
  for (const std::string& node : kGameNodes) {
    test::Process process(
        {program("nacre_" + node), "--run-dir", run.string(), "--port", std::to_string(test::test_port())},
        folder / node);
    EXPECT_EQ(process.wait(20.0), 1) << node;
    EXPECT_THAT(read_file(folder / node), AnyOf(HasSubstr("No space left on device"), HasSubstr("disk is full"),
                                                HasSubstr("Make room on its disk")))
        << node;
  }
  ballast.close();
  EXPECT_EQ(test::Process({"umount", disk.string()}, errors).wait(5), 0);
}

}  // namespace
}  // namespace nacre
