// Whole games with the real programs at tiny fidelity: they end, they survive losses, crashes, noise on the bus and
// people who measure by hand, and they are the same game every time.

#include <csignal>
#include <fstream>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/random.hpp"
#include "persons_game.hpp"
#include "program_test.hpp"
#include "runtime/bus.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "runtime/round_history.hpp"
#include "runtime/run_folder.hpp"
#include "short_game.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre {
namespace {

constexpr double kPatienceS = 240.0;  // for one game, on a machine that does other things too

fs::path written(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// One game is played undisturbed; the others are compared with it and find its simulations in the farm's cache.
class Game : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("games");
    short_game_ = written(folder_ / "short.toml", short_game("short", 2));
    undisturbed_ = std::make_unique<PlayedGame>(short_game_, folder_ / "logs", "undisturbed");
    undisturbed_->play_to_end(kPatienceS);
  }
  static void TearDownTestSuite() { undisturbed_.reset(); }
  void SetUp() override { ASSERT_EQ(undisturbed_->status(), 0) << undisturbed_->said(); }

  static fs::path logs() { return folder_ / "logs"; }
  static fs::path undisturbed_run() { return undisturbed_->folder(); }

  static void expect_undisturbed_course(const fs::path& run) {
    EXPECT_THAT(differences(sent_in_game(undisturbed_run()), sent_in_game(run)), IsEmpty());
  }
  /// Every node says again what its journal holds.
  static void expect_replays(const fs::path& run) {
    for (const std::string& node : kGameNodes) {
      const Outcome replay = run_nacre({"replay", run.string(), "--node", node});
      EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
      EXPECT_THAT(replay.out, HasSubstr("the same, byte for byte"));
    }
  }

  static fs::path folder_;
  static fs::path short_game_;
  static std::unique_ptr<PlayedGame> undisturbed_;
};

fs::path Game::folder_;
fs::path Game::short_game_;
std::unique_ptr<PlayedGame> Game::undisturbed_;

TEST_F(Game, EndsAtItsRoundLimitAndLeavesACompleteFolder) {
  for (const char* file : {"report.html", "run.db", "run.lcm", "laboratory.truth.toml"}) {
    EXPECT_GT(fs::file_size(undisturbed_run() / file), 0U) << file;
  }
  const auto rounds = runtime::read_rounds(undisturbed_run());
  ASSERT_EQ(rounds.size(), 3U);
  EXPECT_FALSE(rounds[0].last || rounds[1].last);
  EXPECT_TRUE(rounds[2].last);
  EXPECT_FALSE(rounds[2].equilibrium) << rounds[2].decided_by;
  const SentInGame said = sent_in_game(undisturbed_run());
  const auto count = [&](const char* channel) { return on_channels(said, {channel}).size(); };
  EXPECT_EQ(count("RUN"), 1U);
  EXPECT_EQ(count("PARAMETERS"), 3U);
  EXPECT_EQ(count("GAMUT"), 3U);
  EXPECT_EQ(count("PROPOSAL"), 3U);
  EXPECT_EQ(count("MEASUREMENT"), 2 * count("TEST_ORDER")) << "two replicates of everything";
  EXPECT_EQ(count("DIAGNOSIS"), 2U);
  EXPECT_THAT(undisturbed_->said(), HasSubstr("the game is over"));
}

TEST_F(Game, LostDatagramsChangeNothing) {
  PlayedGame game(short_game_, logs(), "lossy", "seed=11,drop=0.2");
  ASSERT_TRUE(game.play_to_end(kPatienceS)) << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  expect_undisturbed_course(game.folder());
}

/// A node that is killed when its journal has grown to a share of what it is in the end.
struct Kill {
  std::string node;
  double share = 0.0;
  bool done = false;
};

std::vector<Kill> drawn_kills(std::uint64_t seed, int per_node) {
  RandomStream random(seed, "kills");
  std::vector<Kill> kills;
  for (const std::string& node : kGameNodes) {
    for (int kill = 0; kill < per_node; ++kill) kills.push_back({node, random.uniform(0.001, 0.85)});
  }
  return kills;
}

/// Kills whoever has come so far; a node is not killed twice in one life.
void kill_those_due(PlayedGame& game, const fs::path& undisturbed, std::vector<Kill>& kills,
                    std::map<std::string, int>& killed) {
  for (Kill& kill : kills) {
    const auto whole = static_cast<double>(journal_bytes(undisturbed, kill.node));
    if (kill.done || static_cast<double>(journal_bytes(game.folder(), kill.node)) < kill.share * whole) continue;
    const int process = game.process_of(kill.node);
    if (process == 0 || process == killed[kill.node]) continue;
    killed[kill.node] = process;
    kill.done = ::kill(process, SIGKILL) == 0;
  }
}

TEST_F(Game, KilledNodesGoOnWithTheSameGame) {
  std::vector<Kill> kills = drawn_kills(5, 3);
  std::map<std::string, int> killed;
  // A cache of its own: nodes die while simulations run, and half-filled caches are found again.
  PlayedGame game(short_game_, folder_ / "cold_logs", "killed");
  ASSERT_TRUE(game.play_to_end(kPatienceS, [&] { kill_those_due(game, undisturbed_run(), kills, killed); }))
      << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  for (const Kill& kill : kills) {
    EXPECT_TRUE(kill.done) << kill.node << " at " << kill.share;
    EXPECT_THAT(game.said(), HasSubstr(kill.node + " died (killed by SIGKILL"));
  }
  expect_undisturbed_course(game.folder());
  expect_replays(game.folder());
}

TEST_F(Game, KillsAndLossesTogetherChangeNothing) {
  std::vector<Kill> kills = drawn_kills(6, 1);
  std::map<std::string, int> killed;
  PlayedGame game(short_game_, logs(), "hard", "seed=12,drop=0.2,duplicate=0.1,reorder=0.1,corrupt=0.05");
  ASSERT_TRUE(game.play_to_end(kPatienceS, [&] { kill_those_due(game, undisturbed_run(), kills, killed); }))
      << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  expect_undisturbed_course(game.folder());
}

TEST_F(Game, EverythingKilledAtOnceIsResumedWithTheSameGame) {
  const auto whole = journal_bytes(undisturbed_run(), "validation_agent");
  std::unique_ptr<PlayedGame> game = std::make_unique<PlayedGame>(short_game_, logs(), "resumed");
  for (const double share : {0.2, 0.7}) {
    const fs::path run = game->folder();
    const auto has_come_so_far = [&] {
      return static_cast<double>(journal_bytes(run, "validation_agent")) >= share * static_cast<double>(whole);
    };
    ASSERT_TRUE(game->play_until(has_come_so_far, kPatienceS)) << game->said();
    game->kill_everything();
    game = std::make_unique<PlayedGame>(run);
  }
  ASSERT_TRUE(game->play_to_end(kPatienceS)) << game->said();
  ASSERT_EQ(game->status(), 0) << game->said();
  expect_undisturbed_course(game->folder());
  expect_replays(game->folder());
}

TEST_F(Game, AReplayWithAnotherScenarioSaysSo) {
  const fs::path other =
      written(folder_ / "other.toml", short_game("short", 2) + "[laboratory]\nvirtual_lab = false\n");
  const std::vector<std::string> command = {"replay", undisturbed_run().string(), "--node", "proposal_agent"};
  EXPECT_THAT(run_nacre(command).err, IsEmpty());
  std::vector<std::string> with_other = command;
  with_other.insert(with_other.end(), {"--scenario", other.string()});
  EXPECT_THAT(run_nacre(with_other).err, HasSubstr(other.string() + ": not the scenario that the run was played with"));
}

/// Turns a byte in the middle of the journal.
void damage(const fs::path& journal) {
  std::string bytes = read_file(journal);
  bytes[bytes.find("\xED\xA1\xDA\x01", bytes.size() / 2)] = 'x';
  std::ofstream(journal, std::ios::binary) << bytes;
}

/// One node after the other, the later the further the game has come.
TEST_F(Game, AJournalThatIsDamagedIsMovedAwayAndTheGameIsTheSame) {
  auto game = std::make_unique<PlayedGame>(short_game_, logs(), "damaged");
  const fs::path run = game->folder();
  double share = 0.2;
  for (const std::string& node : kGameNodes) {
    const fs::path journal = journal_of(run, node);
    const double enough = share * static_cast<double>(journal_bytes(undisturbed_run(), node));
    const auto has_come_so_far = [&] { return static_cast<double>(journal_bytes(run, node)) > enough; };
    ASSERT_TRUE(game->play_until(has_come_so_far, kPatienceS)) << node << game->said();
    game->kill_everything();
    damage(journal);
    game = std::make_unique<PlayedGame>(run);
    game->play_to_end(kPatienceS);
    EXPECT_EQ(game->status(), 1) << node;
    EXPECT_THAT(game->said(), AllOf(HasSubstr(journal.string() + ": damaged at byte"), HasSubstr("Move it away"),
                                    HasSubstr("goes on with it, once the cause above is mended")));
    fs::rename(journal, journal.string() + ".damaged");
    game = std::make_unique<PlayedGame>(run);
    share += 0.15;
  }
  ASSERT_TRUE(game->play_to_end(kPatienceS)) << game->said();
  ASSERT_EQ(game->status(), 0) << game->said();
  expect_undisturbed_course(run);
}

/// The specimens of a round as the undisturbed game's laboratory measured them.
std::vector<measurement::SpecimenRecord> specimens_of_round(const fs::path& run, int round) {
  std::vector<measurement::SpecimenRecord> specimens;
  for (const wire::Measurement& taken : measurements_taken(run)) {
    if (taken.round == round) specimens.push_back(taken.record);
  }
  return specimens;
}

TEST_F(Game, MeasurementsBroughtByHandMakeTheSameGameAndCountOnce) {
  std::string text = short_game("short", 2);
  text += "\n[laboratory]\nvirtual_lab = false\n";
  PlayedGame game(written(folder_ / "by_hand.toml", text), logs(), "by_hand");
  const auto ordered = [&](int round) {
    return on_channels(sent_in_game(game.folder()), {"PROPOSAL"}).size() == static_cast<std::size_t>(round);
  };
  auto first = specimens_of_round(undisturbed_run(), 1);
  const auto second = specimens_of_round(undisturbed_run(), 2);
  ASSERT_GT(first.size(), 4U);
  ASSERT_FALSE(second.empty());
  ASSERT_TRUE(game.play_until([&] { return ordered(1); }, kPatienceS)) << game.said();
  // A part of them in another order, with a broken specimen that somebody tested once more.
  measurement::SpecimenRecord broken = first.front();
  broken.specimen += "/broken";
  broken.valid = false;
  broken.note = "slipped in the grips";
  const auto part = inject(folder_ / "part", {first[2], broken, first[0]}, game.folder());
  EXPECT_EQ(part["accepted"], 3) << part;
  const auto whole = inject(folder_ / "whole", first, game.folder());
  EXPECT_EQ(whole["accepted"], first.size() - 2) << whole;
  EXPECT_EQ(whole["repeated"], 2) << whole;
  ASSERT_TRUE(game.play_until([&] { return ordered(2); }, kPatienceS)) << game.said();
  const auto again = inject(folder_ / "whole", first, game.folder());
  EXPECT_EQ(again["accepted"], 0) << again;
  EXPECT_EQ(again["repeated"], first.size()) << again;
  inject(folder_ / "second", second, game.folder());
  ASSERT_TRUE(game.play_to_end(kPatienceS)) << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();

  std::map<std::string, int> times;
  for (const wire::Measurement& taken : measurements_taken(game.folder())) ++times[taken.record.specimen];
  EXPECT_EQ(times.size(), first.size() + second.size() + 1);
  for (const auto& [specimen, count] : times) EXPECT_EQ(count, 1) << specimen;
  const std::vector<std::string> course = {"PARAMETERS", "GAMUT", "PROPOSAL", "TEST_ORDER", "ROUND"};
  EXPECT_THAT(differences(on_channels(sent_in_game(undisturbed_run()), course),
                          on_channels(sent_in_game(game.folder()), course)),
              IsEmpty());
}

/// A person who measures whatever is ordered: one design whose specimens scatter so much that neither growth nor gap
/// can be told from the error of its mean, and nothing else of any worth.
class ScatteredLaboratory {
 public:
  ScatteredLaboratory(const fs::path& folder, const fs::path& run) : folder_(folder), run_(run) {}

  void measure_what_is_ordered() {
    std::vector<measurement::SpecimenRecord> specimens;
    const std::string orders = std::string(runtime::kOutPrefix) + "TEST_ORDER";
    for (const std::string& payload : journaled(run_, "validation_agent", orders)) {
      const auto order = wire::read<wire::TestOrder>(payload).value();
      if (!answered_.insert(order.order_id).second) continue;
      if (scattered_.empty() && order.design.layout() != nullptr) scattered_ = order.design.name();
      for (int k = 1; k <= order.replicates; ++k) specimens.push_back(specimen(order, k));
    }
    if (!specimens.empty()) inject(folder_ / fmt::format("scattered_{}", ++sets_), specimens, run_);
  }

 private:
  measurement::SpecimenRecord specimen(const wire::TestOrder& order, int number) const {
    measurement::SpecimenRecord record;
    record.specimen = fmt::format("{}/{}", order.order_id, number);
    record.design = order.design;
    record.test = order.test;
    record.conditions = order.conditions;
    const bool is_scattered = order.design.name() == scattered_;
    if (order.test == tester::TestKind::modulus) {
      record.modulus_pa = is_scattered ? 1e9 : 2e8;
    } else {
      record.toughness_pa = is_scattered && number % 2 == 0 ? 3e6 : 2e4;
    }
    return record;
  }

  fs::path folder_;
  fs::path run_;
  std::set<std::string> answered_;  // orders
  std::string scattered_;           // the design
  int sets_ = 0;
};

TEST_F(Game, EndsByEquilibriumBeforeItsRoundLimit) {
  std::string text = short_game("short", 5);
  text += "\n[laboratory]\nvirtual_lab = false\n";
  PlayedGame game(written(folder_ / "scattered.toml", text), logs(), "scattered");
  ScatteredLaboratory laboratory(folder_, game.folder());
  ASSERT_TRUE(game.play_to_end(kPatienceS, [&] { laboratory.measure_what_is_ordered(); })) << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  const auto rounds = runtime::read_rounds(game.folder());
  ASSERT_EQ(rounds.size(), 4U) << rounds.back().decided_by;
  for (const auto& round : rounds) {
    EXPECT_EQ(round.last, round.round == 3);
    EXPECT_EQ(round.equilibrium, round.round == 3) << round.decided_by;
  }
}

/// Everything that should not be on a bus, a little of it each time.
class Stranger {
 public:
  Stranger(const fs::path& run, const fs::path& other_run) : random_(7, "stranger"), run_(run) {
    measurement_ = journaled(other_run, "validation_agent", "MEASUREMENT").at(0);
    for (runtime::LogReader reader(other_run / "run.lcm"); auto record = reader.next();) {
      other_game_.push_back({record->channel, record->data});
    }
  }

  void disturb() {
    if (!bus_ && !open()) return;
    constexpr int kAtOnce = 4;
    for (int i = 0; i < kAtOnce; ++i) {
      const auto& [channel, bytes] = other_game_[sent_++ % other_game_.size()];
      bus_->publish_raw(channel, bytes);                             // another run's message
      bus_->publish_raw(channel, damaged(of_this(bytes, channel)));  // this run's, damaged on its way
      bus_->publish_raw(channel, noise());
      bus_->publish_raw("STRANGE", of_this(bytes, channel));
    }
    bus_->publish_raw("MEASUREMENT", impossible_measurement());
    bus_->publish_raw("ROUND", of_this(other_game_.front().bytes, "ROUND"));
  }
  std::size_t sent() const { return sent_; }

 private:
  bool open() {
    if (!fs::exists(run_ / "manifest.json")) return false;
    runtime::BusOptions options;
    const int port = runtime::read_manifest(run_).port;
    if (port == 0) return false;
    options.url = runtime::bus_url(port);
    options.node = "stranger";
    options.run_id = run_.filename();
    bus_ = runtime::Bus::open(options).value();
    return true;
  }
  /// A message of the other game as it would come from this one's virtual laboratory, sound to the last byte.
  std::string of_this(const std::string& bytes, const std::string& channel) {
    const auto blanked = wire::blank_header(channel, bytes);
    return wire::stamp_header(channel, blanked ? blanked->payload : bytes, header());
  }
  wire::Header header() { return {runtime::now_utime(), "virtual_lab", 1, ++sequence_, run_.filename()}; }
  std::string damaged(std::string bytes) {
    bytes[random_.index(static_cast<int>(bytes.size()))] ^= static_cast<char>(1 << random_.index(8));
    return bytes;
  }
  std::string noise() {
    std::string bytes(static_cast<std::size_t>(random_.index(300)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random_.index(256));
    return bytes;
  }
  std::string impossible_measurement() {
    auto message = wire::read<wire::Measurement>(measurement_).value();
    message.record.specimen = fmt::format("stranger/{}", sequence_);
    message.record.modulus_pa = -1e9;
    return wire::stamp_header("MEASUREMENT", wire::write(message), header());
  }

  RandomStream random_;
  fs::path run_;
  std::unique_ptr<runtime::Bus> bus_;
  std::vector<runtime::Datagram> other_game_;
  std::string measurement_;
  std::size_t sent_ = 0;
  std::int64_t sequence_ = 0;
};

TEST_F(Game, CorruptAndForeignMessagesChangeNothing) {
  PlayedGame game(short_game_, logs(), "among_strangers");
  Stranger stranger(game.folder(), undisturbed_run());
  ASSERT_TRUE(game.play_to_end(kPatienceS, [&] { stranger.disturb(); })) << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  expect_undisturbed_course(game.folder());
  for (const wire::Measurement& taken : measurements_taken(game.folder())) {
    EXPECT_THAT(taken.record.specimen, Not(HasSubstr("stranger")));
  }
  EXPECT_GT(stranger.sent(), 100U);
  EXPECT_THAT(game.said(), AllOf(HasSubstr("of run \"undisturbed\""), HasSubstr("it is no round_summary_t")));
  EXPECT_THAT(game.said(), HasSubstr("a message on MEASUREMENT from virtual_lab dropped")) << "an impossible value";
}

TEST_F(Game, ReplayOfEveryNodeSaysTheSame) { expect_replays(undisturbed_run()); }

/// A search that learns works its batches out in processes of their own, from what their spec holds alone.
TEST_F(Game, ALearnedSearchThatWasKilledGoesOnAndThinksTheSameAgain) {
  std::string text = short_game("learned", 1);
  const std::string ten_samples = "samples = 10";
  text.replace(text.find(ten_samples), ten_samples.size(), "samples = 15\nalgorithm = \"learned\"");
  PlayedGame game(written(folder_ / "learned.toml", text), logs(), "learned");
  std::vector<Kill> kills = {{.node = "proposal_agent", .share = 0.5}};
  std::map<std::string, int> killed;
  ASSERT_TRUE(game.play_to_end(kPatienceS, [&] { kill_those_due(game, undisturbed_run(), kills, killed); }))
      << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  EXPECT_TRUE(kills[0].done);
  const Outcome replay = run_nacre({"replay", game.folder().string(), "--node", "proposal_agent", "--recompute"});
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  EXPECT_THAT(replay.out, HasSubstr("the same, byte for byte"));
  EXPECT_THAT(replay.out, Not(HasSubstr(", 0 works done again")));
}

TEST_F(Game, ReplayNamesTheFirstDifference) {
  const fs::path altered = folder_ / "altered";
  fs::copy(undisturbed_run(), altered, fs::copy_options::recursive);
  const std::string first_output = std::string(runtime::kOutPrefix) + "PARAMETERS";
  bool is_altered = false;
  rewrite_journal(journal_of(undisturbed_run(), "validation_agent"), journal_of(altered, "validation_agent"),
                  [&](const std::string& channel, const std::string& data) {
                    if (channel != first_output || std::exchange(is_altered, true)) return data;
                    auto parameters = wire::read<wire::AdoptedModel>(data).value();
                    ++parameters.simulations;
                    return wire::write(parameters);
                  });
  const Outcome replay = run_nacre({"replay", altered.string(), "--node", "validation_agent"});
  EXPECT_EQ(replay.status, 1);
  EXPECT_THAT(replay.out, AllOf(HasSubstr("DIFFERENT"), HasSubstr("first difference: record"),
                                HasSubstr("~out/PARAMETERS"), HasSubstr("simulations")));
}

TEST_F(Game, EveryNodesReplayNoticesAnAlteredOutput) {
  const fs::path altered = folder_ / "altered_everywhere";
  fs::copy(undisturbed_run(), altered, fs::copy_options::recursive);
  for (const std::string& node : kGameNodes) {
    bool is_altered = false;
    rewrite_journal(journal_of(undisturbed_run(), node), journal_of(altered, node),
                    [&](const std::string& channel, std::string data) {
                      if (!channel.starts_with(runtime::kOutPrefix) || std::exchange(is_altered, true)) return data;
                      data.back() = static_cast<char>(data.back() ^ 1);
                      return data;
                    });
    const Outcome replay = run_nacre({"replay", altered.string(), "--node", node});
    EXPECT_EQ(replay.status, 1) << node << replay.out << replay.err;
    EXPECT_THAT(replay.out, HasSubstr("first difference: record"));
  }
}

}  // namespace
}  // namespace nacre
