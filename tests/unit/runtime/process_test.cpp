#include "runtime/process.hpp"

#include <poll.h>
#include <unistd.h>

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/result.hpp"

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
