// Whole games with the real programs at tiny fidelity: they end, they survive losses, crashes, noise on the bus and
// people who measure by hand, and they are the same game every time.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "nacre/parameters_t.hpp"
#include "played_game.hpp"
#include "program.hpp"
#include "runtime/bus.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "runtime/round_history.hpp"
#include "runtime/run_folder.hpp"
#include "wire/channels.hpp"
#include "wire/codec.hpp"
#include "wire/header.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPatienceS = 240.0;  // for one game, on a machine that does other things too

constexpr const char* kShortGame = R"(
name = "short"
seed = 1
rounds = 2
fidelity = "tiny"

[proposal]
samples = 10
seeds = 1
population = 5
designs = 1

[validation]
random_patterns = 2
replicates = 2
calibration_evaluations = 3
modulus_evaluations = 6
mixtures = [0.5]

[diagnosis]
discrimination_orders = 0
bootstraps = 100
)";

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
    short_game_ = written(folder_ / "short.toml", kShortGame);
    undisturbed_ = std::make_unique<PlayedGame>(short_game_, folder_ / "logs", "undisturbed");
    undisturbed_->play_to_end(kPatienceS);
  }
  static void TearDownTestSuite() {
    undisturbed_.reset();
    if (!testing::UnitTest::GetInstance()->Failed()) fs::remove_all(folder_);
  }
  void SetUp() override { ASSERT_EQ(undisturbed_->status(), 0) << undisturbed_->said(); }

  static fs::path logs() { return folder_ / "logs"; }
  static fs::path undisturbed_run() { return undisturbed_->folder(); }

  static void expect_undisturbed_course(const fs::path& run) {
    EXPECT_THAT(differences(said_in_game(undisturbed_run()), said_in_game(run)), IsEmpty());
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
  const SaidInGame said = said_in_game(undisturbed_run());
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

TEST_F(Game, EndsByEquilibriumBeforeItsRoundLimit) {
  // A laboratory so noisy that neither growth nor gap can be told from its errors.
  written(folder_ / "noisy.toml", "seed = 1\nfidelity = \"tiny\"\n[noise]\nmodulus = 0.5\ntoughness = 0.5\n");
  std::string text = kShortGame;
  text.replace(text.find("rounds = 2"), 10, "rounds = 5");
  text += "\n[laboratory]\nfile = \"noisy.toml\"\n";
  PlayedGame game(written(folder_ / "noisy_game.toml", text), logs(), "noisy");
  ASSERT_TRUE(game.play_to_end(kPatienceS)) << game.said();
  ASSERT_EQ(game.status(), 0) << game.said();
  const auto rounds = runtime::read_rounds(game.folder());
  ASSERT_LT(rounds.size(), 6U);
  EXPECT_TRUE(rounds.back().last);
  EXPECT_TRUE(rounds.back().equilibrium) << rounds.back().decided_by;
}

TEST_F(Game, ReplayOfEveryNodeSaysTheSame) { expect_replays(undisturbed_run()); }

TEST_F(Game, ReplayNamesTheFirstDifference) {
  const fs::path altered = folder_ / "altered";
  fs::copy(undisturbed_run(), altered, fs::copy_options::recursive);
  const std::string first_output = std::string(runtime::kOutPrefix) + "PARAMETERS";
  bool is_altered = false;
  rewrite_journal(journal_of(undisturbed_run(), "validation_agent"), journal_of(altered, "validation_agent"),
                  [&](const std::string& channel, const std::string& data) {
                    if (channel != first_output || std::exchange(is_altered, true)) return data;
                    auto parameters = wire::decode_safe<parameters_t>(data).value();
                    ++parameters.simulations;
                    return wire::encode(parameters);
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
