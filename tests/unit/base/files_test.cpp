#include "base/files.hpp"

#include <pthread.h>

#include <atomic>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_aside.hpp"
#include "base/names.hpp"
#include "base/parallel.hpp"

namespace nacre {
namespace {

TEST(Files, PathsReachTheShellAsOneWord) {
  EXPECT_EQ(shell_word("/home/a/run-1.db"), "/home/a/run-1.db");
  EXPECT_EQ(shell_word("/home/a b/$(rm -r x)/it's"), "'/home/a b/$(rm -r x)/it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(Files, ANameAsideIsBesideThePathAndNeverGivenTwice) {
  const std::filesystem::path file = "/folder/film", one = name_aside(file), other = name_aside(file);
  EXPECT_NE(one, other);
  EXPECT_EQ(one.parent_path(), "/folder");
  EXPECT_EQ(one.extension(), ".part");
  EXPECT_THAT(one.filename().string(), testing::StartsWith("film."));
}

TEST(Files, ALinkStaysOneAndItsFileIsWrittenAsItMayBeRead) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / name_aside("files_test");
  std::filesystem::create_directories(folder / "kept");
  write_file_atomically(folder / "kept" / "shared.csv", "old");
  std::filesystem::permissions(folder / "kept" / "shared.csv", std::filesystem::perms::owner_read);
  std::filesystem::create_symlink("kept/shared.csv", folder / "current.csv");
  std::filesystem::create_symlink("current.csv", folder / "link.csv");
  write_file_atomically(folder / "link.csv", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.csv"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "current.csv"));
  EXPECT_EQ(read_file(folder / "kept" / "shared.csv"), "new");
  EXPECT_EQ(std::filesystem::status(folder / "kept" / "shared.csv").permissions(), std::filesystem::perms::owner_read);
  std::filesystem::create_symlink("kept/absent.csv", folder / "dangling.csv");
  write_file_atomically(folder / "dangling.csv", "new");
  EXPECT_EQ(read_file(folder / "kept" / "absent.csv"), "new");
  std::filesystem::remove_all(folder);
}

TEST(NumberBetween, StandsBetweenWordsOrNowhere) {
  EXPECT_EQ(number_between("analyser/r", "/measured", "analyser/r12/measured#ab"), 12);
  EXPECT_EQ(number_between("s", "", "s7"), 7);
  for (const char* other : {"analyser/r/measured", "analyser/r-1/measured", "analyser/r1/films", "analyser/r1",
                            "analyser/r99999999999/measured", "r1/measured", ""}) {
    EXPECT_EQ(number_between("analyser/r", "/measured", other), std::nullopt) << other;
  }
}

TEST(ParallelFor, GoesOnWithTheThreadsThereAre) {
  pthread_attr_t usual, vast;
  ASSERT_EQ(::pthread_getattr_default_np(&usual), 0);
  ASSERT_EQ(::pthread_getattr_default_np(&vast), 0);
  ASSERT_EQ(::pthread_attr_setstacksize(&vast, std::size_t{1} << 47), 0);  // no thread gets a stack like that
  ASSERT_EQ(::pthread_setattr_default_np(&vast), 0);
  std::atomic<int> sum = 0;
  parallel_for(
      100, [&](int i) { sum += i; }, 4);
  ASSERT_EQ(::pthread_setattr_default_np(&usual), 0);
  ::pthread_attr_destroy(&usual);
  ::pthread_attr_destroy(&vast);
  EXPECT_EQ(sum, 4950);
}

}  // namespace
}  // namespace nacre
