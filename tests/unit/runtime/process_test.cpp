#include "runtime/process.hpp"

#include <poll.h>
#include <unistd.h>

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../instrumented.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "temporary_folder.hpp"

namespace nacre::runtime {
namespace {

using testing::ElementsAre;

std::vector<std::string> all_lines(ChildProcess& process) {
  std::vector<std::string> lines;
  while (process.output() >= 0) {
    pollfd wanted{process.output(), POLLIN, 0};
    ::poll(&wanted, 1, 1000);
    for (std::string& line : process.read_lines()) lines.push_back(std::move(line));
  }
  return lines;
}

ProcessEnd end_of(ChildProcess& process) {
  while (!process.poll_end()) ::usleep(1000);
  return *process.poll_end();
}

TEST(ChildProcess, OutputAndErrorsComeAsLinesTheLastOneAlsoUnfinished) {
  ChildProcess process({"/bin/sh", "-c", "echo one; echo two >&2; printf three"});
  EXPECT_THAT(all_lines(process), ElementsAre("one", "two", "three"));
  EXPECT_TRUE(end_of(process).orderly());
}

TEST(ChildProcess, EndIsTheExitStatusOrTheSignal) {
  ChildProcess failing({"/bin/sh", "-c", "exit 7"});
  EXPECT_EQ(end_of(failing).in_words(), "exit status 7");
  ChildProcess killed({"/bin/sleep", "60"});
  killed.signal_group(SIGKILL);
  EXPECT_EQ(end_of(killed).in_words(), "killed by SIGKILL");
}

TEST(ChildProcess, ProgramThatDoesNotExistIsAnErrorThatNamesIt) {
  try {
    ChildProcess process({"/nowhere/program"});
    FAIL() << "started";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/nowhere/program: cannot be started: No such file"));
  }
}

/// A shell within small limits, in a folder of its own.
class LimitedProgram : public testing::Test {
 protected:
  LimitedEnd run(const std::string& script, double patience_s = 20) {
    const LimitedEnd end = run_limited({"/bin/sh", "-c", script}, limits_, patience_s);
    for (const auto& file : {limits_.output_file, limits_.error_file})
      EXPECT_LE(std::filesystem::file_size(file), limits_.file_bytes);
    return end;
  }
  TemporaryFolder folder_;
  ProcessLimits limits_{.folder = folder_.path(),
                        .output_file = folder_.path() / "output",
                        .error_file = folder_.path() / "errors",
                        .memory_bytes = 1u << 30,
                        .file_bytes = 1u << 20,
                        .processor_s = 20};
};

TEST_F(LimitedProgram, WorksInItsFolderAndWritesIntoItsFiles) {
  const LimitedEnd end = run("pwd; echo wrong >&2; exit 3");
  EXPECT_EQ(read_file(limits_.output_file), folder_.path().string() + "\n");
  EXPECT_EQ(read_file(limits_.error_file), "wrong\n");
  EXPECT_EQ(end.end.exit_status, 3);
  EXPECT_FALSE(end.is_late);
}

TEST_F(LimitedProgram, WhatTakesTooLongIsKilledWithAllThatItStarted) {
  const LimitedEnd end = run("sleep 60 & wait", 0.3);
  EXPECT_TRUE(end.is_late);
  EXPECT_EQ(end.end.signal, SIGKILL);
}

TEST_F(LimitedProgram, ABusyOneIsKilledAfterItsTimeOnTheProcessor) {
  limits_.processor_s = 1;
  const LimitedEnd end = run("while :; do :; done", 60);
  EXPECT_NE(end.end.signal, 0);
  EXPECT_FALSE(end.is_late);
}

TEST_F(LimitedProgram, WritesNoFileWithoutEnd) {
  for (const char* script : {"exec yes", "exec yes >&2"}) EXPECT_EQ(run(script).end.signal, SIGXFSZ) << script;
}

TEST_F(LimitedProgram, MemoryBeyondTheLimitIsNotThere) {
  if (test::kIsInstrumented) GTEST_SKIP() << "sanitizers reserve more addresses than may be limited";
  limits_.memory_bytes = 64u << 20;
  EXPECT_FALSE(run("head -c 300000000 /dev/zero | tail -c 200000000").end.orderly());
}

TEST_F(LimitedProgram, AFolderThatIsNotThereIsAnError) {
  limits_.folder = "/nowhere";
  EXPECT_THROW(run_limited({"/bin/true"}, limits_, 1), InputError);
}

TEST(ChildProcess, SignalReachesTheWholeGroup) {
  ChildProcess process({"/bin/sh", "-c", "sleep 60 & echo started; wait"});
  pollfd wanted{process.output(), POLLIN, 0};
  ::poll(&wanted, 1, 5000);
  process.signal_group(SIGTERM);
  // The pipe closes only when the grandchild has ended, too.
  EXPECT_THAT(all_lines(process), ElementsAre("started"));
}

TEST(ChildProcess, IsKilledWithTheObject) {
  pid_t pid = 0;
  {
    ChildProcess process({"/bin/sleep", "60"});
    pid = process.pid();
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_EQ(::kill(pid, 0), -1) << "still there, or not reaped";
}

TEST(AskProgram, ReturnsOutputAndEnd) {
  const ProgramOutput answer = ask_program({"/bin/echo", "hello"});
  EXPECT_EQ(answer.output, "hello\n");
  EXPECT_TRUE(answer.end.orderly());
  EXPECT_EQ(ask_program({"/nowhere/program"}).end.exit_status, 127);
}

}  // namespace
}  // namespace nacre::runtime
