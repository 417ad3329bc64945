#include "runtime/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include <lcm/lcm-cpp.hpp>

#include "base/files.hpp"
#include "temporary_folder.hpp"

namespace nacre::runtime {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void write_records(const std::filesystem::path& path, int count, std::size_t size = 50) {
  LogWriter writer(path);
  for (int i = 0; i < count; ++i) {
    ASSERT_TRUE(writer.append(1000 + i, "CHANNEL", std::to_string(i) + std::string(size, 'x')));
  }
  ASSERT_TRUE(writer.flush());
}

void overwrite(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

int count_records(const std::filesystem::path& path) {
  LogReader reader(path);
  int count = 0;
  while (reader.next()) ++count;
  return count;
}

TEST(LogFile, IsReadByLcmsOwnReader) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "log.lcm";
  write_records(path, 5);
  lcm::LogFile log(path.string(), "r");
  for (int i = 0; i < 5; ++i) {
    const lcm::LogEvent* event = log.readNextEvent();
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(event->eventnum, i);
    EXPECT_EQ(event->timestamp, 1000 + i);
    EXPECT_EQ(event->channel, "CHANNEL");
    EXPECT_EQ(std::string(static_cast<char*>(event->data), 1), std::to_string(i));
  }
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST(LogFile, ATornTailAnywhereKeepsAllWholeRecords) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "log.lcm";
  write_records(path, 4);
  const std::string whole = read_file(path);
  const std::size_t record = whole.size() / 4;
  for (std::size_t length = 0; length < whole.size(); length += 5) {
    overwrite(path, whole.substr(0, length));
    LogReader reader(path);
    std::size_t count = 0;
    while (reader.next()) ++count;
    EXPECT_EQ(count, length / record);
    EXPECT_EQ(static_cast<std::size_t>(reader.end().sound_bytes), count * record);
    EXPECT_EQ(static_cast<std::size_t>(reader.end().torn_bytes), length - count * record);
  }
}

TEST(LogFile, DamageInTheMiddleIsAnErrorThatNamesThePlaceAndReadingCanGoOn) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "log.lcm";
  write_records(path, 10);
  std::string bytes = read_file(path);
  const std::size_t record = bytes.size() / 10;
  bytes[3 * record + 26] = '\x7f';  // the data length of record 3: it now runs past the end, as a torn tail would
  overwrite(path, bytes);
  LogReader reader(path);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(reader.next());
  try {
    reader.next();
    FAIL() << "expected an error";
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("damaged at byte " + std::to_string(3 * record)));
    EXPECT_THAT(problem.what(), HasSubstr("byte " + std::to_string(4 * record)));
  }
  reader.resync();
  EXPECT_EQ(reader.next()->number, 4);
}

TEST(LogFile, ZerosBehindTheEndAreATornTail) {  // what some file systems leave after a power failure
  const TemporaryFolder folder;
  const auto path = folder.path() / "log.lcm";
  write_records(path, 3);
  overwrite(path, read_file(path) + std::string(4096, '\0'));
  EXPECT_EQ(count_records(path), 3);
}

TEST(LogFile, AnythingElseIsNoLogAndNoJournalCutsItOff) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "journal.lcm";
  const std::string text = "specimen,pattern,test\nA1,rigid,modulus\n";
  overwrite(path, text);
  EXPECT_THAT([&] { LogReader reader(path); }, ThrowsMessage<InputError>(HasSubstr("journal.lcm: no LCM log")));
  EXPECT_THROW(Journal::open(folder.path(), 1), InputError);
  EXPECT_EQ(read_file(path), text);
  for (const std::string& nothing : {std::string(), std::string(100, '\0')}) {
    overwrite(path, nothing);
    EXPECT_EQ(count_records(path), 0);
  }
}

TEST(LogFile, AFullDiskIsAnErrorAndNothingFollowsIt) {
  LogWriter writer("/dev/full");
  Result<void> written = writer.append(1, "CHANNEL", "some bytes");
  if (written) written = writer.flush();
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("No space left"));
  EXPECT_FALSE(writer.append(2, "CHANNEL", "more"));
}

TEST(Records, ComeApartAsTheyWerePackedAndDamageIsFound) {
  const std::vector<std::string> fields{"id", "", std::string("a\0b", 3)};
  EXPECT_EQ(*unpack(pack(fields)), fields);
  std::string damaged = pack(fields);
  for (std::size_t i = 0; i < damaged.size(); ++i) {
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    EXPECT_FALSE(unpack(damaged)) << i;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
  }
  EXPECT_FALSE(unpack(""));
}

TEST(Journal, KeepsItsIdentityAndNumbersOnAcrossOpenings) {
  const TemporaryFolder folder;
  ASSERT_TRUE(Journal::open(folder.path(), 111)->append(1, "A", "x"));
  const auto again = Journal::open(folder.path(), 222);
  EXPECT_EQ(again->identity(), 111);
  EXPECT_EQ(count_records(again->path()), 2);
  ASSERT_TRUE(again->append(2, "B", "y"));
  LogReader reader(folder.path() / "journal.lcm");
  for (std::int64_t number = 0; number < 3; ++number) EXPECT_EQ(reader.next()->number, number);
}

TEST(Journal, CutsATornTailAndTakesANewIdentity) {
  const TemporaryFolder folder;
  ASSERT_TRUE(Journal::open(folder.path(), 111)->append(1, "A", "kept"));
  const auto path = folder.path() / "journal.lcm";
  overwrite(path, read_file(path) + "\xED\xA1\xDA\x01 half a rec");
  const auto mended = Journal::open(folder.path(), 222);
  EXPECT_THAT(mended->warning(), HasSubstr("cut off"));
  EXPECT_EQ(mended->identity(), 222);  // what the tail held may have been acknowledged: it must come again
  LogReader reader(path);
  reader.next();
  EXPECT_EQ(reader.next()->data, "kept");
  EXPECT_EQ(reader.next()->channel, kJournalChannel);
}

TEST(Journal, TakesANewIdentityInEveryBootOfTheMachineAndInNoOther) {
  const TemporaryFolder folder;
  ASSERT_TRUE(Journal::open(folder.path(), 111, "boot 1")->append(1, "A", "kept"));
  const auto path = folder.path() / "journal.lcm";
  const std::size_t on_disk = read_file(path).size();
  ASSERT_TRUE(Journal::open(folder.path(), 222, "boot 1")->append(1, "A", "acknowledged, not on disk"));
  // The power fails. What is lost ends where a record ends: nothing is torn.
  overwrite(path, read_file(path).substr(0, on_disk));
  for (const std::int64_t now : {333, 444}) {
    const auto again = Journal::open(folder.path(), now, "boot 2");
    EXPECT_EQ(again->identity(), 333) << "what was lost must come again, and once";
    EXPECT_EQ(again->warning(), "");
  }
  EXPECT_EQ(count_records(path), 3);
}

TEST(Journal, OfBeforeBootsWereWrittenDownIsReadAndTakesANewIdentityOnce) {
  const TemporaryFolder folder;
  {
    LogWriter writer(folder.path() / "journal.lcm");
    ASSERT_TRUE(writer.append(111, kJournalChannel, pack({"111"})));
    ASSERT_TRUE(writer.append(112, "A", "kept"));
  }
  for (const std::int64_t now : {222, 333}) EXPECT_EQ(Journal::open(folder.path(), now, "boot")->identity(), 222);
  EXPECT_EQ(count_records(folder.path() / "journal.lcm"), 3);
}

TEST(Journal, IsNotOpenedTwice) {
  const TemporaryFolder folder;
  const auto first = Journal::open(folder.path(), 1);
  try {
    Journal::open(folder.path(), 2);
    FAIL() << "expected an error";
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("pid " + std::to_string(getpid())));
  }
}

TEST(Journal, AFileSizeLimitLeavesAJournalThatResumes) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{3000, 3000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto journal = Journal::open(folder.path(), 1);
    int kept = 0;
    while (journal->append(1, "A", std::string(100, 'x'))) ++kept;
    _exit(kept);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  const int kept = WEXITSTATUS(status);
  EXPECT_GT(kept, 10);
  const auto journal = Journal::open(folder.path(), 2);
  EXPECT_GE(count_records(journal->path()), kept);  // all that was reported written is there
  EXPECT_TRUE(journal->append(2, "A", "goes on"));
}

TEST(Lock, WhoIsThereForAMomentIsWaitedForAndWhoStaysIsNot) {
  const TemporaryFolder folder;
  auto held = std::make_unique<FolderLock>(folder.path());
  EXPECT_THAT([&] { Journal::open(folder.path(), 1); }, ThrowsMessage<InputError>(HasSubstr("another process")));
  std::thread leaves([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    held.reset();
  });
  EXPECT_NO_THROW(Journal::open(folder.path(), 1));
  leaves.join();
}

}  // namespace
}  // namespace nacre::runtime
