// A game on two machines: two networks joined by a pair of virtual cables, the farm on one side, everybody else on the
// other.

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "played_game.hpp"
#include "program_test.hpp"
#include "runtime/bus.hpp"
#include "runtime/round_history.hpp"

namespace nacre {
namespace {

using runtime::ChildProcess;

constexpr double kPatienceS = 240.0;
constexpr int kPort = 7766;

constexpr const char* kScenario = R"(name = "two_machines"
hosts = "{}"
rounds = 1
fidelity = "tiny"
[proposal]
samples = 8
seeds = 1
population = 4
designs = 1
[validation]
random_patterns = 1
replicates = 1
mixtures = []
calibration_evaluations = 2
modulus_evaluations = 6
[diagnosis]
enabled = false
)";

/// Another machine, as far as the network goes.
class OtherMachine {
 public:
  OtherMachine() : holder_({"unshare", "--net", "sleep", "600"}) {
    const std::string script = std::string(NACRE_SOURCE_DIR) + "/tests/multiprocess/second_network.sh";
    ChildProcess shell({"/bin/sh", script, std::to_string(holder_.pid())});
    const auto end = wait_for_end(shell, problem_, 20.0);
    if (end.exit_status == 0 && end.signal == 0) problem_.clear();
  }
  ~OtherMachine() {
    ChildProcess shell({"/bin/sh", "-c", "ip link delete here; ip route replace 224.0.0.0/4 dev lo"});
    std::string said;
    wait_for_end(shell, said, 20.0);
    holder_.signal_group(SIGKILL);
  }
  /// Why there is no other machine; empty when there is.
  const std::string& problem() const { return problem_; }
  std::vector<std::string> command(const std::vector<std::string>& words) const {
    std::vector<std::string> all = {"nsenter", "--net", "-t", std::to_string(holder_.pid())};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }

 private:
  ChildProcess holder_;
  std::string problem_;
};

fs::path written(const fs::path& folder, const std::string& hosts) {
  std::ofstream(folder / "two_machines.toml") << fmt::format(fmt::runtime(kScenario), hosts);
  return folder / "two_machines.toml";
}

TEST(TwoMachines, FarmOnOneAndEverybodyElseOnTheOtherPlayTheGameToItsEnd) {
  const char* isolated = std::getenv("NACRE_ISOLATED");
  if (isolated == nullptr || std::string(isolated) != "1") GTEST_SKIP() << "network namespaces are not allowed here";
  const OtherMachine other;
  if (!other.problem().empty()) GTEST_SKIP() << "a second network is not allowed here: " << other.problem();
  const fs::path folder = fresh_folder("two_machines"), here = folder / "here", there = folder / "there";
  fs::create_directories(there / "logs");
  std::string said_here, said_there;
  ChildProcess host({program("nacre"), "launch", written(folder, "lan").string(), "--logs", (here / "logs").string(),
                     "--run", "game", "--port", std::to_string(kPort), "--elsewhere", "simulator_farm"});
  ASSERT_TRUE(wait_until_said(host, "validation_agent of run game listens", said_here, kPatienceS)) << said_here;
  fs::create_directories(there / "logs/game");
  for (const auto& entry : fs::directory_iterator(here / "logs/game")) {
    const fs::path name = entry.path().filename(), copy = there / "logs/game" / name;
    std::error_code gone;  // the game is playing: what was written aside is renamed meanwhile
    if (name != "nodes") fs::copy(entry, copy, fs::copy_options::recursive, gone);
  }
  ChildProcess guest(other.command(
      {program("nacre"), "launch", "--resume", (there / "logs/game").string(), "--only", "simulator_farm"}));
  const auto host_end = wait_for_end(host, said_here, kPatienceS);
  const auto guest_end = wait_for_end(guest, said_there, kPatienceS);
  EXPECT_EQ(host_end.exit_status + host_end.signal, 0) << said_here;
  EXPECT_EQ(guest_end.exit_status + guest_end.signal, 0) << said_there;

  EXPECT_THAT(said_here, AllOf(HasSubstr("simulator_farm reports from elsewhere"), HasSubstr("the game is over")));
  EXPECT_THAT(said_there, AllOf(HasSubstr("round 1: gap "), HasSubstr("the game is over")));
  const auto rounds = runtime::read_rounds(here / "logs/game");
  ASSERT_EQ(rounds.size(), 2U);
  EXPECT_TRUE(rounds.back().last);
  EXPECT_FALSE(fs::exists(journal_of(here / "logs/game", "simulator_farm")));
  EXPECT_GT(journaled(there / "logs/game", "simulator_farm", "SIMULATE").size(), 5U);
  EXPECT_FALSE(fs::exists(journal_of(there / "logs/game", "validation_agent")));
}

TEST(TwoMachines, AGameThatIsOverIsKnownToBeWhereverTheValidationAgentRuns) {
  const char* isolated = std::getenv("NACRE_ISOLATED");
  if (isolated == nullptr || std::string(isolated) != "1") GTEST_SKIP() << "network namespaces are not allowed here";
  const OtherMachine other;
  if (!other.problem().empty()) GTEST_SKIP() << "a second network is not allowed here: " << other.problem();
  const fs::path folder = fresh_folder("agent_elsewhere"), run = folder / "logs/game";  // shared by the machines
  const std::vector<std::string> anew = {written(folder, "lan").string(),
                                         "--logs",
                                         (folder / "logs").string(),
                                         "--run",
                                         "game",
                                         "--port",
                                         std::to_string(kPort)};
  for (const std::vector<std::string>& what : {anew, {"--resume", run.string()}}) {
    std::string said_here, said_there;
    std::vector<std::string> command = {program("nacre"), "launch"};
    command.insert(command.end(), what.begin(), what.end());
    command.insert(command.end(), {"--elsewhere", "validation_agent"});
    ChildProcess host(command);
    ASSERT_TRUE(wait_until_said(host, "analyser of run game listens", said_here, kPatienceS)) << said_here;
    ChildProcess guest(
        other.command({program("nacre"), "launch", "--resume", run.string(), "--only", "validation_agent"}));
    const auto host_end = wait_for_end(host, said_here, kPatienceS);
    const auto guest_end = wait_for_end(guest, said_there, kPatienceS);
    EXPECT_EQ(host_end.exit_status + host_end.signal, 0) << said_here;
    EXPECT_EQ(guest_end.exit_status + guest_end.signal, 0) << said_there;
  }
}

TEST(TwoMachines, NeedAScenarioThatLeavesTheMachineAndAWayOut) {
  const fs::path folder = fresh_folder("one_machine");
  const auto refusal = [&](const std::string& hosts, const std::string& node) {
    const Outcome outcome = run_nacre(
        {"launch", written(folder, hosts).string(), "--logs", (folder / "logs").string(), "--elsewhere", node});
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    return outcome.err;
  };
  EXPECT_THAT(refusal("local", "simulator_farm"), HasSubstr("expected hosts = \"lan\""));
  EXPECT_THAT(refusal("lan", "simulator"), HasSubstr("simulator: no node of this run: expected one of"));
  if (runtime::multicast_source(kPort).value_or("") == "127.0.0.1") {  // as in a network of its own (isolated.sh)
    EXPECT_THAT(refusal("lan", "simulator_farm"), HasSubstr("ip route replace 224.0.0.0/4 dev INTERFACE"));
  }
  EXPECT_FALSE(fs::exists(folder / "logs"));
}

}  // namespace
}  // namespace nacre
