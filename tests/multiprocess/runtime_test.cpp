// The shell around real processes: loss, kills, lost journals, hostile datagrams, full disks. Whatever happens, the
// game of the two echo nodes must equal the undisturbed one.

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <deque>
#include <fstream>
#include <set>

#include "../unit/runtime/temporary_folder.hpp"
#include "base/files.hpp"
#include "base/random.hpp"
#include "echo_cores.hpp"
#include "processes.hpp"
#include "runtime/endpoint.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_pieces.hpp"
#include "runtime/node_shell.hpp"
#include "runtime/recorder.hpp"
#include "runtime/replay.hpp"
#include "runtime/work_pool.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/schema.hpp"

namespace nacre {
namespace {

using runtime::Message;
using test::Process;
using testing::HasSubstr;

using Said = std::set<std::pair<std::string, std::string>>;  ///< channel, payload

/// What the two nodes say in a perfect world: the cores alone, without processes and network.
Said undisturbed_game() {
  Said said;
  echo::AskerCore asker;
  echo::FarmCore farm;
  wire::RunStart run;
  run.scenario_hash = "echo";
  run.schema_version = 1;
  std::deque<Message> queue{{"RUN", wire::write(run)}};
  while (!queue.empty()) {
    const Message message = queue.front();
    queue.pop_front();
    if (message.channel != "RUN") said.emplace(message.channel, message.payload);
    for (runtime::NodeCore* core : {static_cast<runtime::NodeCore*>(&asker), static_cast<runtime::NodeCore*>(&farm)}) {
      if ((message.channel == "SIMULATE") != (core == &farm)) continue;
      runtime::Outputs outputs = core->step(message);
      for (const Message& next : outputs.messages) queue.push_back(next);
      for (const runtime::Compute& compute : outputs.computes) {
        const auto done = core->step(runtime::WorkDone{compute.id, echo::echo_work(compute.spec)});
        queue.insert(queue.end(), done.messages.begin(), done.messages.end());
      }
    }
  }
  return said;
}

/// In words, and only the first one: the messages themselves are long.
std::string difference(const Said& actual, const Said& expected) {
  const auto missing_from = [](const Said& from, const Said& other, const std::string& what) -> std::string {
    for (const auto& [channel, payload] : other) {
      if (from.count({channel, payload})) continue;
      const auto json = wire::to_json(wire::find_channel(channel)->type, payload);
      return what + " " + channel + " " + (json ? json->dump().substr(0, 300) : json.error().message);
    }
    return {};
  };
  const std::string missing = missing_from(actual, expected, "never said:");
  return missing.empty() ? missing_from(expected, actual, "said too much:") : missing;
}

/// A game of two echo processes, watched from outside.
class EchoGame {
 public:
  explicit EchoGame(std::string faults = "") : faults_(std::move(faults)) {
    runtime::BusOptions options;
    options.url = runtime::bus_url(port());
    options.node = "launcher";
    options.run_id = run_id();
    auto opened = runtime::Endpoint::open(std::move(options), echo::kParticipants);
    if (!opened) throw std::runtime_error(opened.error().message);
    launcher_ = std::move(*opened);
    wire::RunStart run;
    run.scenario_hash = "echo";
    run.schema_version = 1;
    EXPECT_TRUE(launcher_->offer({"RUN", wire::write(run)}));
  }

  int port() const { return test::test_port(); }
  std::string run_id() const { return folder_.path().filename(); }
  std::filesystem::path node_dir(const std::string& node) const { return folder_.path() / "nodes" / node; }
  std::filesystem::path journal(const std::string& node) const { return node_dir(node) / "journal.lcm"; }
  std::string errors(const std::string& node) const { return read_file(folder_.path() / (node + ".err")); }
  runtime::Endpoint& launcher() { return *launcher_; }
  Process& process(const std::string& node) { return processes_.at(node); }

  std::vector<std::string> command(const std::string& node) const {
    return {NACRE_TEST_BINARY_DIR "/echo_node",
            "--node",
            node,
            "--run-dir",
            folder_.path().string(),
            "--port",
            std::to_string(port())};
  }

  void start(const std::string& node, std::vector<std::string> wrapper = {}) {
    const std::vector<std::string> own = command(node);
    wrapper.insert(wrapper.end(), own.begin(), own.end());
    std::vector<std::string> environment;
    if (!faults_.empty()) environment.push_back("NACRE_FAULTS=" + faults_);
    processes_.insert_or_assign(node, Process(wrapper, folder_.path() / (node + ".err"), environment));
    status_.erase(node);
  }
  void start_all() {
    for (const std::string& node : echo::kParticipants) start(node);
  }
  void kill(const std::string& node) { processes_.at(node).kill(); }

  /// Watches until `condition` or the time is over.
  bool watch(double timeout_s, const std::function<bool()>& condition) {
    const std::int64_t end = runtime::now_utime() + static_cast<std::int64_t>(1e6 * timeout_s);
    while (!condition()) {
      if (runtime::now_utime() > end) return false;
      launcher_->pump(10, [this](const runtime::Received& received) {
        if (received.message.channel != "STATUS") return;
        if (const auto status = wire::read<wire::NodeStatus>(received.message.payload)) {
          status_[received.header.node] = *status;
        }
      });
    }
    return true;
  }
  bool play(double timeout_s = 40) {
    return watch(timeout_s,
                 [this] { return status_["proposal_agent"].finished != 0 && status_["simulator_farm"].finished != 0; });
  }
  const wire::NodeStatus& status(const std::string& node) { return status_[node]; }

  /// Everything that stands in the journals as said.
  Said said() const {
    Said all;
    for (const std::string& node : echo::kParticipants) {
      if (!std::filesystem::exists(journal(node))) continue;
      runtime::LogReader reader(journal(node));
      while (const auto record = reader.next()) {
        if (!record->channel.starts_with(runtime::kOutPrefix)) continue;
        all.emplace(record->channel.substr(runtime::kOutPrefix.size()), record->data);
      }
    }
    return all;
  }

  void expect_replays() const {
    for (const std::string& node : echo::kParticipants) {
      const auto core = echo::make_core(node);
      const runtime::ReplayReport report = runtime::replay_journal(journal(node), *core, echo::echo_functions(), true);
      EXPECT_TRUE(report.equal) << node << ": " << report.difference;
      EXPECT_EQ(report.unfinished, 0) << node;
      EXPECT_GE(report.outputs, echo::kRequests) << node;
    }
  }

 private:
  std::string faults_;
  TemporaryFolder folder_;
  std::unique_ptr<runtime::Endpoint> launcher_;
  std::map<std::string, Process> processes_;
  std::map<std::string, wire::NodeStatus> status_;
};

std::int64_t retries(EchoGame& game) {
  return game.status("proposal_agent").retries + game.status("simulator_farm").retries;
}

TEST(Shell, UndisturbedGameEqualsTheCoresAloneAndReplays) {
  EchoGame game;
  game.start_all();
  ASSERT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  game.expect_replays();
  RecordProperty("retries", std::to_string(retries(game)));
}

TEST(Shell, StopsInOrderOnSigterm) {
  EchoGame game;
  game.start_all();
  ASSERT_TRUE(game.watch(10, [&] { return game.status("simulator_farm").ready != 0; }));
  game.process("simulator_farm").signal(SIGTERM);
  EXPECT_EQ(game.process("simulator_farm").wait(5), 0);
  EXPECT_THAT(game.errors("simulator_farm"), HasSubstr("stopped in order"));
}

TEST(Shell, LossRepetitionReorderingAndDamageChangeNothing) {
  EchoGame game("seed=7,drop=0.2,duplicate=0.05,reorder=0.05,corrupt=0.01");
  game.start_all();
  ASSERT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  EXPECT_GT(retries(game), 10);
  EXPECT_GT(game.status("proposal_agent").duplicates + game.status("simulator_farm").duplicates, 0);
  EXPECT_GT(game.status("proposal_agent").rejected + game.status("simulator_farm").rejected, 0);
  game.expect_replays();
  RecordProperty("retries", std::to_string(retries(game)));
}

TEST(Shell, DatagramsDroppedByThePacketFilterChangeNothing) {
  if (!test::isolated()) GTEST_SKIP() << "no network of its own";
  const TemporaryFolder folder;
  const auto rules = folder.path() / "rules.nft";
  std::ofstream(rules) << "table inet chaos {\n  chain in {\n    type filter hook input priority 0; policy accept;\n"
                       << "    iifname \"lo\" udp dport " << test::test_port()
                       << " numgen random mod 100 < 20 counter drop\n  }\n}\n";
  if (Process({"nft", "-f", rules}, folder.path() / "nft.err").wait(5) != 0) GTEST_SKIP() << "nft does not work here";
  EchoGame game;
  game.start_all();
  EXPECT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  EXPECT_GT(retries(game), 10);
  RecordProperty("retries", std::to_string(retries(game)));
  EXPECT_EQ(Process({"nft", "delete", "table", "inet", "chaos"}, folder.path() / "nft.err").wait(5), 0);
}

TEST(Shell, KillsAtAnyInstantChangeNothing) {
  EchoGame game("seed=3,drop=0.1");
  game.start_all();
  RandomStream random(11, "kills");
  for (int i = 0; i < 8; ++i) {
    const std::string& victim = echo::kParticipants[i % 2];
    const std::int64_t until = runtime::now_utime() + 20'000 + random.index(300'000);
    game.watch(1, [&] { return runtime::now_utime() >= until; });
    game.kill(victim);
    game.start(victim);
  }
  ASSERT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  game.expect_replays();
}

TEST(Shell, LostJournalsAreMadeUpForByTheOthers) {
  for (const std::string& victim : echo::kParticipants) {
    EchoGame game;
    game.start_all();
    ASSERT_TRUE(game.watch(10, [&] { return game.said().size() >= 40; }));
    game.kill(victim);
    std::filesystem::remove(game.journal(victim));
    game.start(victim);
    ASSERT_TRUE(game.play()) << victim;
    // The farm may still be sending again what the asker knows already.
    EXPECT_TRUE(game.watch(10, [&] { return game.said() == undisturbed_game(); })) << victim;
  }
}

/// What a power cut may leave of a journal that was not on disk yet: its first half, whole records, and the machine
/// comes up in another boot.
void cut_power(const std::filesystem::path& journal) {
  std::vector<runtime::LogRecord> records;
  {
    runtime::LogReader reader(journal);
    while (auto record = reader.next()) records.push_back(*std::move(record));
  }
  std::filesystem::remove(journal);
  runtime::LogWriter writer(journal);
  for (std::size_t i = 0; i < records.size() / 2; ++i) {
    const runtime::LogRecord& record = records[i];
    const std::string data = record.channel == runtime::kJournalChannel
                                 ? runtime::pack({runtime::unpack(record.data)->front(), "the boot before"})
                                 : record.data;
    ASSERT_TRUE(writer.append(record.utime, record.channel, data));
  }
  ASSERT_TRUE(writer.flush());
}

TEST(Shell, AJournalThatAPowerCutShortenedToWholeRecordsIsMadeUpForByTheOthers) {
  for (const std::string& victim : echo::kParticipants) {
    EchoGame game;
    game.start_all();
    ASSERT_TRUE(game.watch(10, [&] { return game.said().size() >= 40; }));
    for (const std::string& node : echo::kParticipants) game.kill(node);
    cut_power(game.journal(victim));
    game.start_all();
    ASSERT_TRUE(game.play()) << victim;
    EXPECT_TRUE(game.watch(10, [&] { return game.said() == undisturbed_game(); })) << victim;
  }
}

void send_raw_datagrams(int port, int count) {
  const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  const int stay_on_this_host = 0;
  ::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_TTL, &stay_on_this_host, sizeof stay_on_this_host);
  RandomStream random(5, "datagrams");
  for (int i = 0; i < count; ++i) {
    std::string bytes(static_cast<std::size_t>(random.index(300)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.index(256));
    if (i % 2 == 0 && bytes.size() > 8) bytes.replace(0, 4, i % 4 == 0 ? "LC02" : "LC03");  // LCM's own magic numbers
    ::sendto(fd, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group), sizeof group);
  }
  ::close(fd);
}

TEST(Shell, CorruptAndForeignMessagesChangeNothing) {
  EchoGame game;
  runtime::BusOptions options;
  options.url = runtime::bus_url(game.port());
  options.node = "simulator_farm";
  options.run_id = "another run";
  const auto foreign = std::move(*runtime::Bus::open(options));
  const auto disturb = [&](int i) {
    wire::SimulateResult lie{
        "proposal_agent/0/" + std::to_string(i), 0, 1, 0, {{echo::design_of(i), "", 1.0, 0.0, 0.0, 0, 0.0, 0.0, {}}}};
    foreign->publish({"SIMULATED", wire::write(lie)});
    std::string bytes = wire::stamp_header("SIMULATED", wire::write(lie), {1, "simulator_farm", 1, 1, game.run_id()});
    bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 8);
    foreign->publish_raw("SIMULATED", bytes);
    foreign->publish_raw("SIMULATE", bytes);
    foreign->publish_raw("STATUS", "");
    foreign->publish_raw("NOT_OURS", "bytes");
    send_raw_datagrams(game.port(), 10);
  };
  game.start_all();
  int disturbances = 0;
  ASSERT_TRUE(game.watch(20, [&] {  // before, during and after the game
    if (disturbances < 100) disturb(disturbances++ % echo::kRequests);
    return game.status("proposal_agent").rejected >= 100 && game.status("proposal_agent").finished != 0;
  }));
  ASSERT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr("of run \"another run\""));
  game.expect_replays();
}

TEST(Shell, AFullDiskStopsTheNodeWithASentenceAndNothingAcknowledgedIsLost) {
  EchoGame game;
  game.start("simulator_farm");
  game.start("proposal_agent", {"bash", "-c", "ulimit -f 16; exec \"$0\" \"$@\""});  // 16 kB for any file
  ASSERT_TRUE(game.watch(20, [&] { return game.process("proposal_agent").wait(0) == 1; }));
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr("cannot be written"));
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr("nothing that it acknowledged is lost"));
  game.start("proposal_agent");
  ASSERT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  game.expect_replays();
}

TEST(Shell, AFullFileSystemStopsTheNodeAndItResumesWhenThereIsRoom) {
  const TemporaryFolder folder;
  const auto problems = folder.path() / "mount.err";
  const auto small = [&](const std::string& options, const std::string& where) {
    return Process({"mount", "-t", "tmpfs", "-o", options, "nacre-test", where}, problems).wait(5) == 0;
  };
  EchoGame game;
  const std::string where = game.node_dir("proposal_agent");
  std::filesystem::create_directories(where);
  if (!test::isolated() || !small("size=24k", where)) GTEST_SKIP() << "no file system can be mounted here";
  game.start_all();
  EXPECT_TRUE(game.watch(20, [&] { return game.process("proposal_agent").wait(0) == 1; }));
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr("No space left on device"));
  ASSERT_TRUE(small("remount,size=16m", where));
  game.start("proposal_agent");
  EXPECT_TRUE(game.play());
  EXPECT_EQ(difference(game.said(), undisturbed_game()), "");
  game.kill("proposal_agent");
  EXPECT_EQ(Process({"umount", where}, problems).wait(5), 0);
}

TEST(Shell, AFileSystemThatIsFullAtTheFirstStartIsNoBadInput) {
  const TemporaryFolder folder;
  const auto problems = folder.path() / "mount.err";
  EchoGame game;
  const std::string where = game.node_dir("proposal_agent");
  std::filesystem::create_directories(where);
  if (!test::isolated() ||
      Process({"mount", "-t", "tmpfs", "-o", "size=1m", "nacre-test", where}, problems).wait(5) != 0)
    GTEST_SKIP() << "no file system can be mounted here";
  std::ofstream(where + "/ballast") << std::string(1 << 20, 'x');
  game.start("proposal_agent");
  EXPECT_EQ(game.process("proposal_agent").wait(5), 1);
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr("No space left on device"));
  std::filesystem::remove(where + "/ballast");
  game.start("proposal_agent");
  EXPECT_TRUE(game.watch(10, [&] { return game.status("proposal_agent").ready != 0; }));
  game.kill("proposal_agent");
  EXPECT_EQ(Process({"umount", where}, problems).wait(5), 0);
}

TEST(Shell, DamageInTheMiddleOfTheJournalIsRefusedWithItsPlace) {
  EchoGame game;
  game.start_all();
  ASSERT_TRUE(game.play());
  game.kill("proposal_agent");
  std::string bytes = read_file(game.journal("proposal_agent"));
  bytes[bytes.find("\xED\xA1\xDA\x01", bytes.size() / 2)] = 'x';
  std::ofstream(game.journal("proposal_agent"), std::ios::binary | std::ios::trunc) << bytes;
  game.start("proposal_agent");
  EXPECT_EQ(game.process("proposal_agent").wait(5), 2);
  const std::string journal = game.journal("proposal_agent").string();
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr(journal + ": damaged at byte"));
  EXPECT_THAT(game.errors("proposal_agent"), HasSubstr("Move it away"));
  std::filesystem::rename(journal, journal + ".damaged");
  game.start("proposal_agent");
  EXPECT_TRUE(game.play()) << "as it says";
}

TEST(Shell, ASecondProcessOfTheSameNodeIsRefused) {
  EchoGame game;
  game.start("simulator_farm");
  ASSERT_TRUE(game.watch(10, [&] { return game.status("simulator_farm").ready != 0; }));
  const TemporaryFolder folder;
  Process second(game.command("simulator_farm"), folder.path() / "err");
  EXPECT_EQ(second.wait(5), 2);
  EXPECT_THAT(read_file(folder.path() / "err"), HasSubstr("another process"));
}

TEST(Shell, ASecondProcessIsRefusedBeforeItHasAnExecutor) {
  const TemporaryFolder folder;
  runtime::NodeOptions options;
  options.node = "simulator_farm";
  options.run_dir = folder.path();
  options.url = runtime::bus_url(test::test_port());
  options.follow_parent = false;
  options.participants = echo::kParticipants;
  const auto first = runtime::Journal::open(options.node_dir(), 1);
  const auto mark = folder.path() / "an executor was made";
  const pid_t second = ::fork();
  if (second == 0) {
    const runtime::MakeExecutor make = [&](std::function<void()> wake) {
      std::ofstream(mark) << "perhaps with files that the first process works on";
      return std::make_unique<runtime::WorkPool>(echo::echo_functions(), 1, std::move(wake));
    };
    ::_exit(runtime::run_node(options, echo::make_core(options.node), {}, make));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(second, &status, 0), second);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST(Shell, WithoutAMulticastRouteTheRemedyIsNamed) {
  if (!test::isolated()) GTEST_SKIP() << "no network of its own";
  EchoGame game;
  game.start("simulator_farm", {"unshare", "-n"});
  EXPECT_EQ(game.process("simulator_farm").wait(5), 2);
  EXPECT_THAT(game.errors("simulator_farm"), HasSubstr("ip route add 224.0.0.0/4 dev lo"));
}

TEST(Shell, LeavesNoOrphanWhenItsParentDies) {
  EchoGame game;
  game.start("simulator_farm", {"bash", "-c", "\"$0\" \"$@\"; true"});  // bash stays as the parent
  ASSERT_TRUE(game.watch(10, [&] { return game.status("simulator_farm").ready != 0; }));
  game.kill("simulator_farm");  // kills the parent
  const auto folder = game.node_dir("simulator_farm");
  EXPECT_TRUE(game.watch(5, [&] {
    try {
      runtime::Journal::open(folder, 1);  // free again: the node is gone
      return true;
    } catch (const InputError&) {
      return false;
    }
  }));
}

TEST(Recorder, AFullDiskIsNoBadInputAndItMayBeStartedAgain) {
  const TemporaryFolder folder;
  runtime::RecorderOptions options;
  options.log = folder.path() / "run.lcm";
  options.url = runtime::bus_url(test::test_port());
  const pid_t recorder = ::fork();
  if (recorder == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4000, 4000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(runtime::run_recorder(options, [] { return false; }));
  }
  EchoGame game;
  int status = 0;
  ASSERT_TRUE(game.watch(20, [&] {
    game.launcher().bus().publish({"ACK", wire::write(wire::Ack{})});
    return ::waitpid(recorder, &status, WNOHANG) == recorder;
  }));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

int acks_of_launcher(const std::filesystem::path& log) {
  int acks = 0;
  runtime::LogReader reader(log);
  while (const auto record = reader.next()) {
    if (record->channel != "ACK") continue;
    const auto blanked = wire::blank_header(record->channel, record->data);
    acks += blanked && blanked->header.node == "launcher";
  }
  return acks;
}

TEST(Recorder, KeepsABurstOfEveryMessageOnTheBus) {
  const TemporaryFolder folder;
  runtime::RecorderOptions options;
  options.log = folder.path() / "run.lcm";
  options.url = runtime::bus_url(test::test_port());
  std::atomic<bool> stop = false;
  std::thread recorder([&] { EXPECT_EQ(runtime::run_recorder(options, [&] { return stop.load(); }), 0); });
  EchoGame game;
  game.start_all();
  EXPECT_TRUE(game.play());
  for (int i = 0; i < 200; ++i) game.launcher().bus().publish({"ACK", wire::write(wire::Ack{})});
  game.watch(20, [&] { return acks_of_launcher(options.log) == 200; });
  stop = true;
  recorder.join();
  Said recorded;
  runtime::LogReader reader(options.log);
  while (const auto record = reader.next()) {
    EXPECT_NE(record->channel, "LCM_SELF_TEST");
    const auto blanked = wire::blank_header(record->channel, record->data);
    ASSERT_TRUE(blanked) << record->channel;
    if (record->channel.starts_with("SIMULATE") || record->channel == "PROPOSAL")
      recorded.emplace(record->channel, blanked->payload);
  }
  EXPECT_EQ(acks_of_launcher(options.log), 200);
  EXPECT_EQ(difference(recorded, undisturbed_game()), "");
  for (const std::string& node : echo::kParticipants) {
    const auto core = echo::make_core(node);
    const auto report = runtime::replay_bus_log(options.log, node, *core, echo::echo_functions());
    EXPECT_TRUE(report.equal) << node << ": " << report.difference;
  }
}

/// `count` messages of the launcher, recorded in pieces of about 3 kB by a recorder that ends or, with `kill`, is
/// killed.
void record_messages(const runtime::RecorderOptions& options, EchoGame& game, int first, int count, bool kill) {
  const pid_t recorder = ::fork();
  if (recorder == 0) {
    static std::atomic<bool> stop = false;
    std::signal(SIGTERM, [](int) { stop = true; });
    ::_exit(runtime::run_recorder(options, [] { return stop.load(); }));
  }
  wire::RoundSummary round;
  const auto recorded = [&] {
    std::set<int> rounds;
    try {
      for (runtime::PiecesReader reader(options.log); const auto record = reader.next();)
        if (record->channel == "ROUND")
          rounds.insert(wire::read<wire::RoundSummary>(wire::blank_header("ROUND", record->data)->payload)->round);
    } catch (const InputError&) {  // is still being made
    }
    return static_cast<int>(rounds.size());
  };
  EXPECT_TRUE(game.watch(30, [&] {
    for (round.round = first; round.round < first + count; ++round.round)
      game.launcher().bus().publish({"ROUND", wire::write(round)});
    return recorded() == first + count;
  }));
  ::kill(recorder, kill ? SIGKILL : SIGTERM);
  int status = 0;
  ::waitpid(recorder, &status, 0);
}

TEST(Recorder, GoesOnInPiecesThatBeginWithTheStateAndAreReadAsOne) {
  const TemporaryFolder folder;
  runtime::RecorderOptions options;
  options.log = folder.path() / "run.lcm";
  options.url = runtime::bus_url(test::test_port());
  options.most_bytes = 2000;  // of 2900 that ten messages take, sent once
  EchoGame game;
  record_messages(options, game, 0, 10, true);
  const std::size_t pieces_before = runtime::pieces_of(options.log).size();
  std::ofstream(runtime::pieces_of(options.log).back(), std::ios::app) << "torn";
  record_messages(options, game, 10, 10, false);
  const auto pieces = runtime::pieces_of(options.log);
  EXPECT_GT(pieces_before, 1U);
  EXPECT_GT(pieces.size(), pieces_before);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    runtime::LogReader reader(pieces[i]);
    EXPECT_EQ(reader.next()->channel, runtime::kPieceChannel);
    std::string first = reader.next()->channel;
    if (first == "RUN") first = reader.next()->channel;  // the launcher offers it again where a recorder is late
    EXPECT_EQ(first, "ROUND") << pieces[i] << " begins with the state";
    EXPECT_LT(std::filesystem::file_size(pieces[i]), 2 * 2000U);
  }
}

}  // namespace
}  // namespace nacre
