#include "store/simulation_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/parallel.hpp"
#include "base/result.hpp"

namespace nacre::store {
namespace {

using testing::HasSubstr;

class SimulationCacheFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / "nacre_simulation_cache_test";
    std::filesystem::remove_all(folder_);
    path_ = folder_ / "simulations.db";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string refusal() {
    try {
      SimulationCache cache(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_, path_;
};

CachedSimulation toughness_result() {
  CachedSimulation result;
  result.toughness_pa = 123456.789012345;
  result.peak_stress_pa = 4e6;
  result.failure_strain = 0.031;
  result.curve = {{0.0, 0.5, 1.0}, {0.0, 2.5, 1.25}};
  return result;
}
const CachedSimulation kResult = toughness_result();

CachedSimulation failed(const std::string& reason) {
  CachedSimulation result;
  result.failure = reason;
  return result;
}

TEST_F(SimulationCacheFile, AResultOutlivesTheProcessThatWroteIt) {
  SimulationCache(path_).insert("key", kResult);
  const SimulationCache again(path_);
  EXPECT_EQ(again.find("key"), kResult);
  EXPECT_EQ(again.find("another"), std::nullopt);
}

TEST_F(SimulationCacheFile, TheFirstResultStays) {
  SimulationCache cache(path_);
  cache.insert("key", kResult);
  cache.insert("key", failed("blow-up"));
  EXPECT_EQ(cache.find("key"), kResult);
  EXPECT_EQ(cache.size(), 1);
}

TEST_F(SimulationCacheFile, AFailureIsAResult) {
  SimulationCache cache(path_);
  cache.insert("key", failed("J = -0.1 at element 7"));
  EXPECT_EQ(cache.find("key"), failed("J = -0.1 at element 7"));
}

TEST_F(SimulationCacheFile, ThreadsAndASecondConnectionWriteSideBySide) {
  SimulationCache first(path_), second(path_);
  parallel_for(
      200, [&](int i) { (i % 2 ? first : second).insert("key " + std::to_string(i), kResult); }, 4);
  EXPECT_EQ(first.size(), 200);
  EXPECT_EQ(second.find("key 101"), kResult);
}

TEST_F(SimulationCacheFile, BreaksAreKeptWithTheResult) {
  SimulationCache cache(path_);
  cache.insert("key", kResult);
  EXPECT_EQ(cache.find_breaks("key"), std::nullopt) << "they were not asked for";
  const std::vector<tester::Break> breaks = {{31'999, 0.25}, {7, 0.5}};
  cache.insert_breaks("key", breaks);
  cache.insert_breaks("key", {});
  cache.insert_breaks("unbroken", {});
  EXPECT_EQ(SimulationCache(path_).find_breaks("key"), breaks);
  EXPECT_EQ(cache.find_breaks("unbroken"), std::vector<tester::Break>{});
  EXPECT_EQ(cache.find("key"), kResult);
}

TEST_F(SimulationCacheFile, AnOlderFileKeepsItsResults) {
  SimulationCache(path_).insert("key", kResult);
  {
    SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
    database.exec("DROP TABLE breaks");
    database.exec("ALTER TABLE simulation DROP COLUMN checksum");
    database.exec("PRAGMA user_version = 1");
  }
  SimulationCache cache(path_);
  EXPECT_EQ(cache.find("key"), kResult);
  cache.insert_breaks("key", {{1, 0.5}});
  EXPECT_TRUE(cache.find_breaks("key"));
}

TEST_F(SimulationCacheFile, AFileOfVersionTwoKeepsItsResultsAndCracks) {
  {
    SimulationCache cache(path_);
    cache.insert("key", kResult);
    cache.insert_breaks("key", {{1, 0.5}});
  }
  {
    SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
    for (const char* table : {"simulation", "breaks"}) {
      database.exec(std::string("ALTER TABLE ") + table + " DROP COLUMN checksum");
    }
    database.exec("PRAGMA user_version = 2");
  }
  const SimulationCache cache(path_);
  EXPECT_EQ(cache.find("key"), kResult);
  EXPECT_EQ(cache.find_breaks("key"), (std::vector<tester::Break>{{1, 0.5}}));
}

TEST_F(SimulationCacheFile, AValueThatWasAlteredIsNotBelieved) {
  SimulationCache cache(path_);
  cache.insert("key", kResult);
  SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("UPDATE simulation SET modulus_pa = modulus_pa + 1");
  EXPECT_THROW(cache.find("key"), InputError);
}

TEST_F(SimulationCacheFile, AFileThatIsNoDatabaseIsRefusedByNameWithARemedy) {
  std::filesystem::create_directories(folder_);
  std::ofstream(path_) << std::string(5000, 'x');
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("simulations.db"), HasSubstr("move the file")));
}

TEST_F(SimulationCacheFile, ADamagedDatabaseIsRefused) {
  {
    SimulationCache cache(path_);
    for (int i = 0; i < 500; ++i) cache.insert("key " + std::to_string(i), kResult);
  }
  ASSERT_GT(std::filesystem::file_size(path_), 20'000u);
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(8192);
  file << std::string(8192, 'x');
  file.close();
  EXPECT_THAT(refusal(), HasSubstr("cannot be used"));
}

TEST_F(SimulationCacheFile, AnotherSchemaVersionIsRefused) {
  { SimulationCache cache(path_); }
  SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
  EXPECT_THAT(refusal(), HasSubstr("schema version 99"));
}

TEST_F(SimulationCacheFile, ACacheThatAnotherProgramWritesAsksForPatienceAndNotForARebuild) {
  SimulationCache cache(path_, 10);
  SQLite::Database other(path_.string(), SQLite::OPEN_READWRITE);
  other.exec("BEGIN IMMEDIATE");
  std::string said;
  try {
    cache.insert("key", kResult);
  } catch (const DatabaseUnavailable& error) {
    said = error.what();
  }
  EXPECT_THAT(said, testing::AllOf(HasSubstr("another program"), testing::Not(HasSubstr("rebuild"))));
  EXPECT_THROW(SimulationCache(path_, 10), DatabaseUnavailable);
  other.exec("ROLLBACK");
  EXPECT_TRUE(cache.insert("key", kResult));
}

TEST_F(SimulationCacheFile, AFullDiskAsksForRoomAndNotForARebuild) {
  SimulationCache cache(path_);
  cache.insert("key", kResult);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1 << 16, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string said;
  try {
    for (int i = 0; i < 1000; ++i) cache.insert("key " + std::to_string(i), kResult);
  } catch (const DatabaseUnavailable& error) {
    said = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(said, testing::AllOf(HasSubstr("Make room"), testing::Not(HasSubstr("rebuild"))));
  EXPECT_EQ(cache.find("key"), kResult);
  cache.insert("later", kResult);
  EXPECT_EQ(cache.find("later"), kResult);
}

TEST_F(SimulationCacheFile, AFolderInTheWayIsNamed) {
  std::filesystem::create_directories(path_);
  EXPECT_THAT(refusal(), HasSubstr("simulations.db"));
}

}  // namespace
}  // namespace nacre::store
