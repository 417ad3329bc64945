// What the doctor finds on a machine that something is wrong with, and that typing what it says mends it.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/timex.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "doctor_checks.hpp"
#include "processes.hpp"
#include "program_test.hpp"
#include "runtime/process.hpp"
#include "store/database_care.hpp"
#include "store/simulation_cache.hpp"

namespace nacre {
namespace {

using Json = nlohmann::json;

/// The doctor's word on one thing.
struct Said {
  int status = 0;
  Json finding;
  std::string verdict() const { return finding.value("verdict", "none"); }
  std::string remedy() const { return finding.value("remedy", ""); }
};

void type(const std::string& command) {
  const auto answer = runtime::ask_program({"sh", "-c", command});
  EXPECT_TRUE(answer.end.orderly()) << command << ": " << answer.output;
}

class Doctor : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    logs_ = folder_ / "logs";
    fs::create_directories(logs_);
  }
  Said examine(const std::string& check, std::vector<std::string> arguments = {}) const {
    std::vector<std::string> command = {"doctor", "--logs", logs_.string(), "--json"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_nacre(command);
    const Json findings = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(findings.is_discarded()) << outcome.status << outcome.err;
    if (findings.is_discarded()) return {outcome.status, Json::object()};
    for (const Json& finding : findings) {
      if (finding["check"] == check) return {outcome.status, finding};
    }
    return {outcome.status, Json::object()};
  }
  fs::path folder_, logs_;
};

TEST_F(Doctor, IsContentWithAMachineThatPlays) {
  for (const char* check : {"programs of the nodes", "versions", "UDP port", "multicast route", "messages come back",
                            "disk space", "disk writes", "cache of simulations"}) {
    EXPECT_EQ(examine(check).verdict(), "good") << check;
  }
}

TEST_F(Doctor, MissingRouteForMulticastIsAFaultAndItsRemedyMendsIt) {
  if (!test::isolated()) GTEST_SKIP() << "no network of its own";
  type("ip route del 224.0.0.0/4");
  const Said said = examine("multicast route");
  EXPECT_EQ(said.verdict(), "fault");
  EXPECT_EQ(said.status, 1);
  type(said.remedy());
  EXPECT_EQ(examine("multicast route").verdict(), "good");
}

TEST_F(Doctor, MulticastThatStaysHereIsAFaultOnlyForSeveralMachines) {
  if (!test::isolated()) GTEST_SKIP() << "no network of its own";
  EXPECT_EQ(examine("multicast route").verdict(), "good");
  std::ofstream(folder_ / "lan.toml") << "hosts = \"lan\"\n";
  const Said said = examine("multicast route", {"--scenario", (folder_ / "lan.toml").string()});
  EXPECT_EQ(said.verdict(), "fault");
  EXPECT_THAT(said.remedy(), HasSubstr("ip route replace 224.0.0.0/4 dev INTERFACE"));
}

TEST_F(Doctor, AFirewallThatEatsMessagesIsAFault) {
  if (!test::isolated()) GTEST_SKIP() << "no network of its own";
  std::ofstream(folder_ / "rules.nft")
      << "table inet doctor {\n  chain in {\n    type filter hook input priority 0; policy "
         "accept;\n    ip daddr 239.255.76.67 drop\n  }\n}\n";
  if (!runtime::ask_program({"nft", "-f", (folder_ / "rules.nft").string()}).end.orderly()) {
    GTEST_SKIP() << "nft does not work here";
  }
  const Said said = examine("messages come back");
  type("nft delete table inet doctor");
  EXPECT_EQ(said.verdict(), "fault");
  EXPECT_EQ(said.status, 1);
  EXPECT_THAT(said.remedy(), HasSubstr("239.255.76.67"));
  EXPECT_EQ(examine("messages come back").verdict(), "good");
}

TEST_F(Doctor, APortThatSomebodyElseHasIsAFaultThatNamesIt) {
  const int socket_fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  socklen_t length = sizeof address;
  ASSERT_EQ(::bind(socket_fd, reinterpret_cast<sockaddr*>(&address), length), 0);
  ::getsockname(socket_fd, reinterpret_cast<sockaddr*>(&address), &length);
  const std::string port = std::to_string(ntohs(address.sin_port));
  const Said taken = examine("UDP port", {"--port", port});
  EXPECT_EQ(taken.verdict(), "fault");
  EXPECT_THAT(taken.remedy(), HasSubstr(port));
  ::close(socket_fd);
  EXPECT_EQ(examine("UDP port", {"--port", port}).verdict(), "good");
}

TEST_F(Doctor, AFullDiskAndOneThatCannotBeWrittenAreFaults) {
  if (::mount("nacre", logs_.c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "no file system can be mounted here";
  std::ofstream(logs_ / "ballast") << std::string(64 << 10, 'x');
  EXPECT_EQ(examine("disk space").verdict(), "fault");
  EXPECT_EQ(examine("disk writes").verdict(), "fault");
  EXPECT_THAT(examine("disk writes").finding["found"].get<std::string>(), HasSubstr("No space left"));
  ASSERT_EQ(::mount(nullptr, logs_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  EXPECT_THAT(examine("disk writes").finding["found"].get<std::string>(), HasSubstr("Read-only"));
  ::umount2(logs_.c_str(), MNT_DETACH);
  EXPECT_EQ(examine("disk writes").verdict(), "good");
}

/// Overwrites some pages in the middle of a file.
void damage(const fs::path& file) {
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
  bytes << std::string(5000, '\x5a');
}

TEST_F(Doctor, ADamagedCacheIsAFaultAndItsRemedySavesTheRest) {
  const fs::path file = logs_ / "simulations.db";
  constexpr int kAnswers = 3000;
  {
    store::SimulationCache cache(file);
    for (int i = 0; i < kAnswers; ++i) {
      store::CachedSimulation answer;
      answer.modulus_pa = 1e9 + i;
      cache.insert(fmt::format("key{:05}", i), answer);
    }
  }
  damage(file);
  const Said said = examine("cache of simulations");
  EXPECT_EQ(said.verdict(), "fault");
  ASSERT_THAT(said.remedy(), HasSubstr("nacre rebuild --cache"));
  type(std::string(NACRE_BINARY_DIR) + "/" + said.remedy());
  EXPECT_EQ(examine("cache of simulations").verdict(), "good");
  const store::SimulationCache saved(file);
  EXPECT_GT(saved.size(), kAnswers / 2);
  for (int i = 0; i < kAnswers; ++i) {
    const auto answer = saved.find(fmt::format("key{:05}", i));
    if (answer) {
      EXPECT_EQ(answer->modulus_pa, 1e9 + i) << "what was saved is as it was";
    }
  }
  EXPECT_TRUE(fs::exists(file.string() + ".damaged"));
}

TEST_F(Doctor, LooksAtCachesWithoutMakingOrChangingThem) {
  const Said none = examine("cache of simulations");
  EXPECT_THAT(none.finding["found"].get<std::string>(), HasSubstr("none yet"));
  EXPECT_TRUE(fs::is_empty(logs_)) << "looking makes none";
  const fs::path file = logs_ / "simulations-cuda.db";
  { const store::SimulationCache cache(file); }
  { const store::SimulationCache cache(logs_ / "simulations.db"); }
  const auto set_version = [&](int version) {
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(fmt::format("PRAGMA user_version = {}", version));
  };
  set_version(2);
  EXPECT_EQ(run_nacre({"doctor", "--logs", logs_.string()}).status, 0);
  EXPECT_EQ(store::schema_version(file), 2) << "looking brings none up to date";
  set_version(99);
  const Outcome outcome = run_nacre({"doctor", "--logs", logs_.string()});
  EXPECT_EQ(outcome.status, 1) << "a device's cache counts, too";
  EXPECT_THAT(outcome.out, HasSubstr("simulations-cuda.db has schema version 99"));
}

TEST_F(Doctor, WhatItSaysToTypeHoldsForFoldersWithBlanks) {
  logs_ = folder_ / "my logs";
  EXPECT_EQ(examine("disk space").verdict(), "fault");
  type(examine("disk space").remedy());
  EXPECT_TRUE(fs::is_directory(logs_));
}

TEST_F(Doctor, ProgramsOfDifferentBuildsAreAFault) {
  const fs::path other = folder_ / "bin";
  fs::create_directories(other);
  fs::copy(program("nacre"), other / "nacre");
  for (const char* node : {"virtual_lab", "simulator_farm", "analyser", "proposal_agent", "validation_agent"}) {
    const fs::path file = other / (std::string("nacre_") + node);
    std::ofstream(file) << "#!/bin/sh\necho nacre 0.0.1, kernel 3, messages 1\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  const auto answer = runtime::ask_program({(other / "nacre").string(), "doctor", "--logs", logs_.string()});
  EXPECT_EQ(answer.end.exit_status, 1);
  EXPECT_THAT(answer.output, AllOf(HasSubstr("fault   versions"), HasSubstr("nacre 0.0.1, kernel 3")));
}

/// sbatch and sinfo that say what a cluster in trouble says.
class FakeCluster {
 public:
  FakeCluster(const fs::path& folder, const std::string& sinfo, const std::string& sbatch = "echo slurm-wlm 22.05.8")
      : path_(std::getenv("PATH")) {
    fs::create_directories(folder);
    write(folder / "sbatch", sbatch);
    write(folder / "sinfo", sinfo);
    ::setenv("PATH", (folder.string() + ":" + path_).c_str(), 1);
  }
  ~FakeCluster() { ::setenv("PATH", path_.c_str(), 1); }

 private:
  static void write(const fs::path& file, const std::string& line) {
    std::ofstream(file) << "#!/bin/sh\n" << line << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  std::string path_;
};

TEST_F(Doctor, AClusterThatTakesNoTasksIsAFaultWhereTheScenarioWantsOne) {
  std::ofstream(folder_ / "slurm.toml") << "[farm]\nexecutor = \"slurm\"\n";
  const std::vector<std::string> wanted = {"--scenario", (folder_ / "slurm.toml").string()};
  {
    const FakeCluster drained(folder_ / "drained", "echo drain 3; echo 'down*' 1");
    EXPECT_EQ(examine("Slurm").verdict(), "remark");
    const Said said = examine("Slurm", wanted);
    EXPECT_EQ(said.verdict(), "fault");
    EXPECT_THAT(said.remedy(), HasSubstr("state=resume"));
    EXPECT_THAT(said.finding["found"].get<std::string>(), HasSubstr("0 of 4 nodes"));
  }
  {
    const FakeCluster silent(folder_ / "silent",
                             "echo 'slurm_load_partitions: Unable to contact slurm controller'; exit 1");
    EXPECT_THAT(examine("Slurm", wanted).finding["found"].get<std::string>(), HasSubstr("Unable to contact"));
  }
  const FakeCluster working(folder_ / "working", "echo mix 2; echo drain 1");
  EXPECT_EQ(examine("Slurm", wanted).verdict(), "good");
}

TEST_F(Doctor, SlurmThatFindsNoClusterIsNotCalledMissing) {
  std::ofstream(folder_ / "slurm.toml") << "[farm]\nexecutor = \"slurm\"\n";
  const std::string refusal = "echo 'sbatch: error: DNS SRV lookup failed' >&2; echo 'sbatch: fatal' >&2; exit 1";
  const FakeCluster lost(folder_ / "lost", refusal, refusal);
  EXPECT_EQ(examine("Slurm").verdict(), "remark");
  const Said said = examine("Slurm", {"--scenario", (folder_ / "slurm.toml").string()});
  EXPECT_EQ(said.verdict(), "fault");
  EXPECT_THAT(said.finding["found"].get<std::string>(),
              AllOf(HasSubstr("DNS SRV lookup failed"), Not(HasSubstr("not installed")), Not(HasSubstr("fatal"))));
  EXPECT_THAT(said.remedy(), HasSubstr("SLURM_CONF"));
}

TEST(Clock, BeforeTheProgramWasWrittenIsAFaultAndOutOfStepARemark) {
  constexpr std::time_t kToday = 1'795'000'000;
  EXPECT_EQ(cli::judge_clock(0, 0).verdict, cli::CheckStatus::fault);
  EXPECT_EQ(cli::judge_clock(kToday, STA_UNSYNC).verdict, cli::CheckStatus::remark);
  EXPECT_EQ(cli::judge_clock(kToday, 0).verdict, cli::CheckStatus::good);
}

}  // namespace
}  // namespace nacre
