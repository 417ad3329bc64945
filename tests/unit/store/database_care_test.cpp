#include "store/database_care.hpp"

#include <unistd.h>

#include <fstream>
#include <utility>
#include <vector>

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "base/random.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::store {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DatabaseFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / fmt::format("nacre-care-{}-{}", ::getpid(),
                                                         testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    file_ = folder_ / "simulations.db";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void fill(int results) const {
    SimulationCache cache(file_);
    for (int i = 0; i < results; ++i) {
      CachedSimulation result;
      result.modulus_pa = 1.0 + i;
      result.curve = {{0.0, 0.5}, {1.0, 2.0}};
      cache.insert(fmt::format("key{:05}", i), result);
      cache.insert_breaks(fmt::format("key{:05}", i), {{i, 0.25}});
    }
  }
  void damage(double from, std::size_t bytes) const {
    std::fstream file(file_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(from * static_cast<double>(fs::file_size(file_))));
    file << std::string(bytes, '\x5a');
  }
  fs::path folder_, file_;
};

TEST_F(DatabaseFile, WholeDamagedMissingAndForeignFilesAreToldApart) {
  EXPECT_THAT(check_database(file_).error().message, HasSubstr("no such file"));
  fill(2000);
  EXPECT_TRUE(check_database(file_));
  damage(0.5, 6000);
  EXPECT_THAT(check_database(file_).error().message, HasSubstr("damaged"));
  std::ofstream(file_) << std::string(5000, 'x');
  EXPECT_THAT(check_database(file_).error().message, HasSubstr("no database"));
}

TEST_F(DatabaseFile, ACopyHoldsWhatWasCommittedAndNotWhatIsBeingWritten) {
  fill(50);
  SQLite::Database writer(file_.string(), SQLite::OPEN_READWRITE);
  writer.exec("BEGIN IMMEDIATE");
  writer.exec("DELETE FROM simulation");
  copy_database(file_, folder_ / "copy.db");
  writer.exec("ROLLBACK");
  EXPECT_TRUE(check_database(folder_ / "copy.db"));
  EXPECT_EQ(SimulationCache(folder_ / "copy.db").size(), 50);
  EXPECT_FALSE(fs::exists(folder_ / "copy.db.part"));
}

TEST_F(DatabaseFile, CopiesNeitherOverAFileNorIntoTheLogOfOneThatIsGone) {
  fill(50);
  const fs::path copy = folder_ / "copy.db";
  {
    SQLite::Database other(copy.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    other.exec("PRAGMA journal_mode = WAL");
    other.exec("CREATE TABLE other (x INTEGER)");
    fs::copy_file(copy.string() + "-wal", folder_ / "left-wal");
    EXPECT_THROW(copy_database(file_, copy), InputError);
  }
  fs::remove(copy);
  fs::copy_file(folder_ / "left-wal", copy.string() + "-wal", fs::copy_options::overwrite_existing);
  copy_database(file_, copy);
  EXPECT_TRUE(check_database(copy));
  EXPECT_EQ(SimulationCache(copy).size(), 50);
}

TEST_F(DatabaseFile, ACopyThatIsNotWholeIsNotLeft) {
  fill(2000);
  damage(0.5, 6000);
  EXPECT_THROW(copy_database(file_, folder_ / "copy.db"), InputError);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_THAT(entry.path().filename().string(), testing::StartsWith("simulations.db"));
}

TEST_F(DatabaseFile, OneThatAnotherProgramKeepsToItselfIsNotCalledDamaged) {
  fill(50);
  SQLite::Database other(file_.string(), SQLite::OPEN_READWRITE);
  other.exec("PRAGMA locking_mode = EXCLUSIVE");
  other.exec("DELETE FROM breaks");
  EXPECT_THROW((void)check_database(file_, 10), DatabaseUnavailable);
}

TEST_F(DatabaseFile, OneCacheIsAddedToAnother) {
  fill(50);
  const fs::path other = folder_ / "other.db";
  EXPECT_EQ(add_simulations(file_, other).simulations, 50);
  SimulationCache used(other);  // by a farm, say
  fill(80);
  EXPECT_EQ(add_simulations(file_, other).simulations, 80);
  EXPECT_EQ(used.size(), 80);
  EXPECT_EQ(used.find("key00079")->modulus_pa, 80.0);
}

/// Somebody who takes a file for themselves as it is opened for the first time, and lets go of it at the second.
struct Rival {
  std::string file;
  sqlite3* held = nullptr;
  bool has_come = false;
  static Rival& instance() {
    static Rival rival;
    return rival;
  }
  static int meet(sqlite3* opened, const char**, const struct sqlite3_api_routines*) {
    Rival& rival = instance();
    const char* name = sqlite3_db_filename(opened, "main");
    if (name == nullptr || rival.file != name) return SQLITE_OK;
    if (!std::exchange(rival.has_come, true)) {  // the rival's own opening comes by here, too
      EXPECT_EQ(sqlite3_open(name, &rival.held), SQLITE_OK);
      EXPECT_EQ(sqlite3_exec(rival.held, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
    } else if (rival.held != nullptr && opened != rival.held) {
      sqlite3_close(std::exchange(rival.held, nullptr));
    }
    return SQLITE_OK;
  }
};

TEST_F(DatabaseFile, ALockIsNoReasonForAnEmptyCopy) {
  fill(50);
  Rival::instance() = {.file = fs::weakly_canonical(folder_ / "copy.db.part").string()};
  const auto meet = reinterpret_cast<void (*)()>(&Rival::meet);
  ASSERT_EQ(sqlite3_auto_extension(meet), SQLITE_OK);
  EXPECT_THROW(copy_database(file_, folder_ / "copy.db"), InputError);
  sqlite3_cancel_auto_extension(meet);
  EXPECT_TRUE(Rival::instance().has_come);
  sqlite3_close(Rival::instance().held);
  for (const char* left : {"copy.db", "copy.db.part"}) EXPECT_FALSE(fs::exists(folder_ / left)) << left;
  copy_database(file_, folder_ / "copy.db");
  EXPECT_EQ(SimulationCache(folder_ / "copy.db").size(), 50);
}

TEST_F(DatabaseFile, SalvageKeepsWhatCanBeReadAndInventsNothing) {
  constexpr int kResults = 3000;
  RandomStream random(5, "damage");
  for (int round = 0; round < 5; ++round) {
    for (const char* companion : {"", "-wal", "-shm"}) fs::remove(file_.string() + companion);
    fs::remove(folder_ / "saved.db");
    fill(kResults);
    damage(random.uniform(0.1, 0.9), 4096);
    const Salvage saved = salvage_simulations(file_, folder_ / "saved.db");
    EXPECT_GT(saved.simulations, kResults / 3);
    const SimulationCache cache(folder_ / "saved.db");
    EXPECT_EQ(cache.size(), saved.simulations);
    for (int i = 0; i < kResults; ++i) {
      const auto result = cache.find(fmt::format("key{:05}", i));
      if (!result) continue;
      EXPECT_EQ(result->modulus_pa, 1.0 + i);
      EXPECT_EQ(result->curve.stress_pa, (std::vector<double>{1.0, 2.0}));
    }
  }
}

TEST_F(DatabaseFile, DamagedFilesAreKeptUnderNamesOfTheirOwn) {
  for (const char* expected : {"simulations.db.damaged", "simulations.db.damaged-2"}) {
    std::ofstream(file_) << "x";
    EXPECT_EQ(move_aside(file_).filename(), expected);
    EXPECT_FALSE(fs::exists(file_));
  }
}

TEST_F(DatabaseFile, ViewsTriggersAndComputedColumnsOfStrangersAreRefused) {
  const std::vector<std::string> traps = {
      "CREATE VIEW round AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x FROM n) SELECT x FROM n",
      "CREATE TABLE t(a); CREATE TRIGGER trap AFTER INSERT ON t BEGIN DELETE FROM t; END",
      "CREATE TABLE round(a, b AS (a || zeroblob(1000000)))"};
  for (const std::string& trap : traps) {
    fs::remove(file_);
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(trap);
    EXPECT_THROW(SimulationCache cache(file_), InputError) << trap;
    EXPECT_FALSE(check_database(file_)) << trap;
  }
}

}  // namespace
}  // namespace nacre::store
