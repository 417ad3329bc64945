// The launcher against nodes that pretend: readiness, restarts, endings. Real processes, a real bus.

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <thread>

#include "base/files.hpp"
#include "program_test.hpp"
#include "runtime/run_folder.hpp"

namespace nacre {
namespace {

TEST(Processes, ThatEndWhileTheyAreLookedForDisturbNobody) {
  std::atomic<bool> over = false;
  std::thread births([&] {
    while (!over) {
      for (int child = 0; child < 8; ++child) {
        if (::fork() == 0) ::_exit(0);
      }
      while (::waitpid(-1, nullptr, 0) > 0) continue;
    }
  });
  EXPECT_NO_THROW({
    for (int look = 0; look < 5000; ++look) processes_with("nobody has this command line");
  });
  over = true;
  births.join();
}

class Launcher : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "bin");
    for (const char* node : {"virtual_lab", "simulator_farm", "analyser", "proposal_agent", "validation_agent"}) {
      fs::create_symlink(std::string(NACRE_TEST_BINARY_DIR) + "/fake_node",
                         folder_ / "bin" / (std::string("nacre_") + node));
    }
    misbehave("");
  }
  void TearDown() override { EXPECT_THAT(processes_with(folder_.string()), IsEmpty()) << "left behind"; }

  static void misbehave(const std::string& how) { ::setenv("NACRE_FAKE", how.c_str(), 1); }

  std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"launch", "--programs", (folder_ / "bin").string()};
    if (more.empty()) more = {scenario(), "--run", "game"};
    if (more.front() != "--resume") all.insert(all.end(), {"--logs", logs().string()});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::unique_ptr<runtime::ChildProcess> start(std::vector<std::string> more = {}) const {
    std::vector<std::string> command = arguments(std::move(more));
    command.insert(command.begin(), program("nacre"));
    return std::make_unique<runtime::ChildProcess>(command);
  }
  static std::string scenario() { return std::string(NACRE_SOURCE_DIR) + "/launch/tiny.toml"; }
  fs::path logs() const { return folder_ / "logs"; }
  fs::path run() const { return logs() / "game"; }

  fs::path folder_;
};

TEST_F(Launcher, PlaysUntilTheLastRoundAndLeavesACompleteFolder) {
  const Outcome outcome = run_nacre(arguments());
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("every node is ready"), HasSubstr("round 0: nothing measured yet; model not fitted"),
                    HasSubstr("the game is over")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("recorder | "))) << "what nodes log goes to standard error";
  EXPECT_THAT(outcome.err, HasSubstr("recorder | recording into"));
  for (const char* file : {"scenario.toml", "manifest.json", "run.lcm", "inputs/base_materials.csv",
                           "nodes/validation_agent/output.log", "nodes/recorder/output.log"}) {
    EXPECT_TRUE(fs::exists(run() / file)) << file;
  }
  EXPECT_EQ(fs::read_symlink(logs() / "latest"), "game");
  EXPECT_THAT(read_file(run() / "manifest.json"), AllOf(HasSubstr("\"commit\""), HasSubstr("\"port\"")));
  const Outcome recorded = run_nacre({"echo", "--log", (run() / "run.lcm").string()});
  EXPECT_EQ(recorded.status, 0) << recorded.err;
  EXPECT_THAT(recorded.out, AllOf(HasSubstr("\"channel\":\"RUN\""), HasSubstr("\"channel\":\"ROUND\""),
                                  HasSubstr("\"fidelity_name\":\"")));
}

TEST_F(Launcher, AReaderOfItsOutputWhoGoesEarlyTakesNothingFromTheGame) {
  std::string command = program("nacre");
  for (const std::string& argument : arguments()) command += " " + shell_word(argument);
  const auto printed =
      runtime::ask_program({"bash", "-c", command + " 2>/dev/null | head -n 1; exit ${PIPESTATUS[0]}"});
  EXPECT_EQ(printed.end.exit_status, 0) << printed.end.in_words();
  EXPECT_THAT(printed.output, HasSubstr("run game on UDP port"));
}

TEST_F(Launcher, NodeThatDiesIsStartedAgainAndTheGameGoesOn) {
  misbehave("analyser:crash=2");
  const Outcome outcome = run_nacre(arguments());
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("analyser died (killed by SIGABRT"), HasSubstr("it is started again in 0.5 s"),
                    HasSubstr("it is started again in 1 s"), HasSubstr("analyser started again")));
}

TEST_F(Launcher, ANodeToBeDebuggedSaysWhereItWaitsUntilCtrlC) {
  const auto process = start({scenario(), "--run", "game", "--debug", "analyser"});
  std::string said;
  ASSERT_TRUE(wait_until_said(*process, "analyser waits for a debugger: gdb -p ", said)) << said;
  const std::vector<int> waiting = processes_with("--wait-for-debugger");
  ASSERT_EQ(waiting.size(), 1U);
  EXPECT_THAT(said, HasSubstr("gdb -p " + std::to_string(waiting.front())));
  process->signal_group(SIGINT);
  EXPECT_EQ(wait_for_end(*process, said).exit_status, 1) << said;
  EXPECT_THAT(said, AllOf(HasSubstr("analyser stopped"), Not(HasSubstr("every node is ready"))));
  EXPECT_THAT(processes_with("--wait-for-debugger"), IsEmpty());
}

TEST_F(Launcher, OnlyANodeThatIsStartedHereCanBeDebugged) {
  const Outcome unknown = run_nacre(arguments({scenario(), "--run", "game", "--debug", "analyzer"}));
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("analyzer: no node of this run: expected one of"));
}

TEST_F(Launcher, NodeThatDiesTooOftenEndsTheRunWithItsName) {
  misbehave("analyser:crash=1000");
  const Outcome outcome = run_nacre(arguments({scenario(), "--run", "game", "--restart-s", "0.01"}));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("analyser died too often"), HasSubstr("--resume")));
}

TEST_F(Launcher, NodeThatRefusesItsInputIsNotStartedAgain) {
  misbehave("proposal_agent:refuse");
  const Outcome outcome = run_nacre(arguments());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("proposal_agent cannot work (exit status 2)"), Not(HasSubstr("started again")),
                    HasSubstr("goes on with it, once the cause above is mended")));
}

TEST_F(Launcher, ANodeIsNotStartedInAFolderThatIsNoRunNorForAnotherRun) {
  ASSERT_EQ(run_nacre(arguments()).status, 0);
  const auto start_node = [&](std::vector<std::string> options) {
    options.insert(options.begin(), (folder_ / "bin" / "nacre_analyser").string());
    options.insert(options.end(), {"--port", "7799"});
    runtime::ChildProcess node(options);
    std::string said;
    EXPECT_EQ(wait_for_end(node, said, 10.0).exit_status, 2) << said;
    return said;
  };
  const std::string mistyped = (logs() / "gane").string();
  EXPECT_THAT(start_node({"--run-dir", mistyped}), AllOf(HasSubstr(mistyped), HasSubstr("expected manifest.json")));
  EXPECT_FALSE(fs::exists(mistyped));
  EXPECT_THAT(start_node({"--run-dir", run().string(), "--run-id", "gane"}), HasSubstr("--run-id gane: expected game"));
}

TEST_F(Launcher, ProgramThatVanishesEndsTheRunInOrder) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start({scenario(), "--run", "game", "--restart-s", "0.01"});
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  const std::vector<int> analyser = processes_with("nacre_analyser --run-dir " + run().string());
  ASSERT_EQ(analyser.size(), 1U);
  fs::remove(folder_ / "bin" / "nacre_analyser");
  ::kill(analyser.front(), SIGKILL);
  const runtime::ProcessEnd end = wait_for_end(*process, said, 30.0);
  EXPECT_EQ(end.exit_status, 1) << end.in_words() << said;
  EXPECT_THAT(said, AllOf(HasSubstr("nacre_analyser: cannot be started"), HasSubstr("analyser died too often"),
                          HasSubstr("validation_agent stopped (exit status 0)")));
}

TEST_F(Launcher, RecorderThatDiesTooOftenDoesNotEndTheGame) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start({scenario(), "--run", "game", "--restart-s", "0.01"});
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  const auto recorder = [&] { return processes_with("record --log " + run().string()); };
  while (said.find("recorder died too often") == std::string::npos) {
    ASSERT_TRUE(becomes_true([&] { return recorder().size() == 1; }, 10.0)) << said;
    said.clear();
    ::kill(recorder().front(), SIGKILL);
    ASSERT_TRUE(wait_until_said(*process, "recorder died", said)) << said;
  }
  EXPECT_EQ(run_nacre({"status", "--run", run().string()}).status, 0) << "the nodes play on";
  ::kill(process->pid(), SIGINT);
  wait_for_end(*process, said, 20.0);
  EXPECT_THAT(said, Not(HasSubstr("a node has failed")));
}

TEST_F(Launcher, ARecorderThatCannotBeginIsCalledSo) {
  ASSERT_EQ(run_nacre(arguments()).status, 0);
  fs::remove(run() / "run.lcm");
  fs::create_directory(run() / "run.lcm");
  const Outcome resumed = run_nacre(arguments({"--resume", run().string()}));
  EXPECT_EQ(resumed.status, 1);
  EXPECT_THAT(resumed.out, AllOf(HasSubstr("recorder cannot work"), HasSubstr("the recorder has failed for good"),
                                 Not(HasSubstr("a node has failed"))));
}

TEST_F(Launcher, NodesThatAPersonStopsHaveNotFailed) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start();
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  for (const int node : processes_with("--run-dir " + run().string())) ::kill(node, SIGINT);
  const runtime::ProcessEnd end = wait_for_end(*process, said, 30.0);
  EXPECT_EQ(end.exit_status, 1) << end.in_words() << said;
  EXPECT_THAT(said, AllOf(HasSubstr("analyser stopped (exit status 0)"), HasSubstr("were all stopped by somebody"),
                          Not(HasSubstr("has failed"))));
}

TEST_F(Launcher, ARoundIsShownOnceHoweverOftenItIsReceived) {
  ::setenv("NACRE_FAULTS", "seed=1,duplicate=1", 1);
  const Outcome outcome = run_nacre(arguments());
  ::unsetenv("NACRE_FAULTS");
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const std::string live = outcome.out.substr(0, outcome.out.find("the game is over"));
  const std::size_t first = live.find("round 0: nothing measured yet");
  ASSERT_NE(first, std::string::npos) << live;
  EXPECT_EQ(live.find("round 0: nothing measured yet", first + 1), std::string::npos) << live;
}

TEST_F(Launcher, RunFolderUnderAnotherNameIsResumed) {
  ASSERT_EQ(run_nacre(arguments()).status, 0);
  fs::copy(run(), logs() / "another name", fs::copy_options::recursive);
  const Outcome resumed = run_nacre(arguments({"--resume", (logs() / "another name").string()}));
  EXPECT_EQ(resumed.status, 0) << resumed.out << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr("the game is over"));
}

TEST_F(Launcher, InterruptedRunStopsInOrderAndIsResumed) {
  misbehave("validation_agent:endless");
  std::string said;
  {
    const auto process = start();
    ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
    ::kill(process->pid(), SIGINT);
    const runtime::ProcessEnd end = wait_for_end(*process, said, 20.0);
    EXPECT_EQ(end.exit_status, 1) << end.in_words() << said;
    EXPECT_THAT(said, AllOf(HasSubstr("stopping"), HasSubstr("validation_agent stopped (exit status 0)"),
                            HasSubstr("goes on with it\n")));
    EXPECT_THAT(processes_with(folder_.string()), IsEmpty());
  }
  misbehave("");
  const Outcome resumed = run_nacre(arguments({"--resume", run().string()}));
  EXPECT_EQ(resumed.status, 0) << resumed.out << resumed.err;
}

TEST_F(Launcher, NodeThatIgnoresSignalsIsKilled) {
  misbehave("validation_agent:endless,analyser:deaf");
  std::string said;
  const auto process = start();
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  ::kill(process->pid(), SIGINT);
  const runtime::ProcessEnd end = wait_for_end(*process, said, 30.0);
  EXPECT_EQ(end.exit_status, 1) << end.in_words() << said;
  EXPECT_THAT(said, HasSubstr("analyser stopped (killed by SIGKILL)"));
}

TEST_F(Launcher, KilledLauncherLeavesNothingBehind) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start();
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  EXPECT_GE(processes_with(run().string()).size(), 6U);
  ::kill(process->pid(), SIGKILL);
  wait_for_end(*process, said, 5.0);
  EXPECT_TRUE(becomes_true([&] { return processes_with(run().string()).empty(); }, 5.0));
}

TEST_F(Launcher, RunHasOneLauncherAtATime) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start();
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  const Outcome second = run_nacre(arguments({"--resume", run().string()}));
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("another launcher plays this run"));
  const Outcome same_name = run_nacre(arguments());
  EXPECT_EQ(same_name.status, 2);
  EXPECT_THAT(same_name.err, HasSubstr("exists already"));
  ::kill(process->pid(), SIGINT);
  wait_for_end(*process, said, 20.0);
}

TEST_F(Launcher, PortInUseIsRefusedBeforeAnythingIsMade) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start({scenario(), "--run", "first", "--port", "7791"});
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  const Outcome second = run_nacre(arguments({scenario(), "--run", "second", "--port", "7791"}));
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("UDP port 7791 is in use"));
  EXPECT_FALSE(fs::exists(logs() / "second"));
  ::kill(process->pid(), SIGINT);
  wait_for_end(*process, said, 20.0);
}

TEST_F(Launcher, AGuestWhosePortIsInUseIsNotToldToTakeAnother) {
  ASSERT_EQ(run_nacre(arguments()).status, 0);
  std::string text = read_file(run() / "scenario.toml");
  const std::string local = "hosts = \"local\"";
  ASSERT_NE(text.find(local), std::string::npos) << text;
  write_file_atomically(run() / "scenario.toml", text.replace(text.find(local), local.size(), "hosts = \"lan\""));
  const runtime::PortReservation taken(runtime::read_manifest(run()).port);
  const Outcome guest = run_nacre(arguments({"--resume", run().string(), "--only", "simulator_farm"}));
  EXPECT_EQ(guest.status, 2);
  EXPECT_THAT(guest.err, AllOf(HasSubstr("is in use on this machine, and a guest (--only) cannot take another"),
                               Not(HasSubstr("--port 0"))));
}

TEST_F(Launcher, ProgramsThatAreMissingAreSaidBeforeAnythingIsMade) {
  fs::remove(folder_ / "bin" / "nacre_analyser");
  const Outcome outcome = run_nacre(arguments());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("bin/nacre_analyser: no program"));
  EXPECT_FALSE(fs::exists(logs()));
}

// Slurm that is silent is waited for; one that is not installed would be for ever.
TEST_F(Launcher, AClusterWithoutItsCommandsIsNotWaitedFor) {
  const fs::path farm = folder_ / "bin" / "nacre_simulator_farm", slurm = folder_ / "slurm.toml";
  fs::remove(farm);
  fs::create_symlink(program("nacre_simulator_farm"), farm);
  std::ofstream(slurm) << "[farm]\nexecutor = \"slurm\"\n";
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", (folder_ / "nothing").c_str(), 1);
  const Outcome outcome = run_nacre(arguments({slurm.string(), "--run", "game"}));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("sbatch is not installed"), HasSubstr("apt-get install slurm-client"),
                                 HasSubstr("simulator_farm cannot work (exit status 2)")));
}

TEST_F(Launcher, StatusListsEveryNodeOfTheRun) {
  misbehave("validation_agent:endless");
  std::string said;
  const auto process = start();
  ASSERT_TRUE(wait_until_said(*process, "the game begins", said)) << said;
  const Outcome status = run_nacre({"status", "--run", run().string(), "--json"});
  EXPECT_EQ(status.status, 0) << status.err;
  for (const char* node : {"virtual_lab", "simulator_farm", "analyser", "proposal_agent", "validation_agent"}) {
    EXPECT_THAT(status.out, HasSubstr(std::string("\"node\": \"") + node)) << status.out;
  }
  std::istringstream lines(run_nacre({"echo", "STATUS", "--count", "10", "--run", run().string()}).out);
  std::set<std::string> heard;
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(heard.insert(line).second) << "twice: " << line;
  EXPECT_EQ(heard.size(), 10U);
  ::kill(process->pid(), SIGINT);
  wait_for_end(*process, said, 20.0);
  EXPECT_EQ(run_nacre({"status", "--run", run().string()}).status, 1) << "nobody speaks any more";
}

TEST_F(Launcher, ChangedScenarioCannotBeResumed) {
  ASSERT_EQ(run_nacre(arguments()).status, 0);
  std::ofstream(run() / "scenario.toml", std::ios::app) << "# changed\n";
  const Outcome resumed = run_nacre(arguments({"--resume", run().string()}));
  EXPECT_EQ(resumed.status, 2);
  EXPECT_THAT(resumed.err, HasSubstr("was changed after the run began"));
}

TEST_F(Launcher, FinishedRunIsResumedAndEndsAtOnce) {
  ASSERT_EQ(run_nacre(arguments()).status, 0);
  const Outcome resumed = run_nacre(arguments({"--resume", run().string()}));
  EXPECT_EQ(resumed.status, 0) << resumed.out << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr("the game is over"));
}

/// launch/game, called from another folder than its project's, with a program that says where and how it was called.
class OneCommand : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path folder = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    project_ = folder / "project";
    caller_ = folder / "caller";
    for (const fs::path& each : {project_ / "launch", project_ / "build/bin", caller_}) fs::create_directories(each);
    fs::copy(fs::path(NACRE_SOURCE_DIR) / "launch/game", project_ / "launch/game");
    std::ofstream(project_ / "launch/setup.sh")
        << "give_up() { echo \"$*\"; exit 2; }\nsay() { :; }\ninstall_packages() { :; }\nbuild() { :; }\nbuild_page() "
           "{ :; }\n";
    std::ofstream(project_ / "launch/demo.toml");
    const fs::path nacre = project_ / "build/bin/nacre";
    std::ofstream(nacre) << "#!/bin/sh\npwd\nfor word in \"$@\"; do echo \"$word\"; done\n";
    fs::permissions(nacre, fs::perms::owner_all);
  }
  /// What the program said, its words in a line each.
  std::string called(const std::vector<std::string>& words) const {
    std::vector<std::string> command = {"/bin/sh", "-c", "cd \"$0\" && exec \"$@\"", caller_.string(),
                                        (project_ / "launch/game").string()};
    command.insert(command.end(), words.begin(), words.end());
    runtime::ChildProcess process(command);
    std::string said;
    wait_for_end(process, said, 20.0);
    return said;
  }
  std::string begun(const std::string& words) const { return caller_.string() + "\nlaunch\n" + words; }
  std::string in_project(const std::string& file) const { return (project_ / file).string() + "\n"; }

  fs::path project_, caller_;
};

TEST_F(OneCommand, PlaysTheDemonstrationAndKeepsRunsInTheProject) {
  const std::string logs = "--logs\n" + in_project("logs");
  EXPECT_EQ(called({}), begun(in_project("launch/demo.toml") + logs));
  EXPECT_EQ(called({"--seed", "2"}), begun(in_project("launch/demo.toml") + logs + "--seed\n2\n"));
  std::ofstream(caller_ / "mine.toml");
  EXPECT_EQ(called({"mine.toml", "--seed", "2"}), begun("mine.toml\n" + logs + "--seed\n2\n"));
  EXPECT_EQ(called({"demo"}), begun(in_project("launch/demo.toml") + logs)) << "by its name";
  EXPECT_THAT(called({"nobodys.toml"}), HasSubstr("nobodys.toml: no such scenario"));
}

TEST_F(OneCommand, GoesOnWithARunAndTakesPathsAsTheCallerMeansThem) {
  EXPECT_EQ(called({"--resume", "kept/RUN"}), begun("--resume\nkept/RUN\n"));
  EXPECT_EQ(called({"--resume=kept/RUN"}), begun("--resume=kept/RUN\n"));
  EXPECT_EQ(called({"--logs", "kept"}), begun(in_project("launch/demo.toml") + "--logs\nkept\n"));
  EXPECT_EQ(called({"--logs=kept"}), begun(in_project("launch/demo.toml") + "--logs=kept\n"));
}

}  // namespace
}  // namespace nacre
