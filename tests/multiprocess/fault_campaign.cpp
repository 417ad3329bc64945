// The fault campaign: short games with real processes under seeded faults, each compared with the undisturbed game.
//   tests/multiprocess/isolated.sh build/bin/fault_campaign --games 200 --folder campaign
// Every game is a row of campaign/games.csv; games that stand there are not played again, so a stopped campaign goes
// on. A game that ends otherwise than the undisturbed one is kept in campaign/failed/SEED. Exit status 1 when there is
// one.

#include <sys/mount.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "disturber.hpp"
#include "program.hpp"
#include "runtime/journal.hpp"
#include "short_game.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kPatienceS = 300.0;  // for one disturbed game
constexpr int kMostResumptions = 40;
constexpr const char* kHead =
    "seed,verdict,wall_s,killed,stopped,locked,disk_full,everything_killed,resumed,measurements,simulations,faults\n";

struct Options {
  fs::path folder = "campaign";
  int games = 200;
  int first_seed = 1;
  double seconds = 0.0;
};

/// What a game leaves behind: what was said, what was measured, what was simulated.
struct PlannedSignatures {
  SentInGame said;
  std::map<std::string, int> measured;   ///< specimens in the validation agent's journal: times
  std::vector<std::string> simulations;  ///< rows of the cache
};

std::vector<std::string> cache_rows(const fs::path& database) {
  SQLite::Database db(database.string(), SQLite::OPEN_READONLY, 10'000);
  SQLite::Statement query(db,
                          "SELECT key || failure || printf('|%!.17g|%!.17g|%!.17g|', modulus_pa, toughness_pa, "
                          "failure_strain) || hex(curve) FROM simulation ORDER BY key");
  std::vector<std::string> rows;
  while (query.executeStep()) rows.push_back(query.getColumn(0).getString());
  return rows;
}

PlannedSignatures planned_signatures_of(const fs::path& run) {
  PlannedSignatures traces;
  traces.said = sent_in_game(run);
  for (const wire::Measurement& taken : measurements_taken(run)) ++traces.measured[taken.record.specimen];
  traces.simulations = cache_rows(run.parent_path() / "simulations.db");
  return traces;
}

/// What is wrong with a game; empty for one that is the undisturbed game.
std::vector<std::string> faults_of(const PlannedSignatures& expected, const PlannedSignatures& actual,
                                   const std::string& said) {
  std::vector<std::string> wrong = differences(expected.said, actual.said);
  if (expected.measured != actual.measured) wrong.push_back("measurements are lost or taken twice");
  if (expected.simulations != actual.simulations) wrong.push_back("the simulations differ");
  if (said.find("was done twice") != std::string::npos) wrong.push_back("a simulation was repeated");
  return wrong;
}

/// A folder for one game, on a file system of its own where that can be had.
class GameFolder {
 public:
  explicit GameFolder(fs::path folder) : folder_(std::move(folder)) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    is_small_disk_ = ::mount("nacre", folder_.c_str(), "tmpfs", 0, "size=48m") == 0;
  }
  ~GameFolder() {
    if (is_small_disk_) ::umount2(folder_.c_str(), MNT_DETACH);
    std::error_code left_behind;
    fs::remove_all(folder_, left_behind);
  }
  bool is_small_disk() const { return is_small_disk_; }

 private:
  fs::path folder_;
  bool is_small_disk_ = false;
};

struct Played {
  std::string verdict;  ///< "same", or what is wrong
  FaultCounts counts;
  int resumed = 0;
  PlannedSignatures traces;
  std::string settings;
};

/// Plays one disturbed game to its end, resuming it whenever it stops.
Played play(std::uint64_t seed, const fs::path& scenario, const fs::path& folder, const PlannedSignatures& expected) {
  const GameFolder place(folder);
  const fs::path run = folder / "game";
  Disturber disturber(seed, run, place.is_small_disk());
  Played played;
  played.settings = disturber.network_and_clock();
  const auto end = Clock::now() + std::chrono::duration<double>(kPatienceS);
  auto game = std::make_unique<PlayedGame>(scenario, folder, "game", played.settings);
  std::string said;
  bool is_over = false;
  while (!is_over && Clock::now() < end && played.resumed < kMostResumptions) {
    bool kill = false;
    game->play_until(
        [&] {
          disturber.disturb(*game);
          kill = disturber.wants_everything_killed();
          return kill || game->is_over() || Clock::now() > end;
        },
        kPatienceS);
    if (kill && !game->is_over()) game->kill_everything();
    is_over = !kill && game->is_over() && game->status() == 0;
    game->play_on();
    said += game->said();
    if (is_over) break;
    disturber.relent();
    ++played.resumed;
    // Killed before its folder was whole, a game is begun anew.
    game.reset();
    if (fs::exists(run / "manifest.json")) {
      game = std::make_unique<PlayedGame>(run, played.settings);
    } else {
      fs::remove_all(run);
      game = std::make_unique<PlayedGame>(scenario, folder, "game", played.settings);
    }
  }
  disturber.relent();
  played.counts = disturber.counts();
  std::vector<std::string> wrong;
  if (!is_over) {
    game->kill_everything();
    wrong.push_back(fmt::format("the game did not end; it said: {}",
                                said.substr(said.size() - std::min<std::size_t>(said.size(), 600))));
  } else {
    played.traces = planned_signatures_of(run);
    wrong = faults_of(expected, played.traces, said);
  }
  played.verdict = wrong.empty() ? "same" : wrong.front();
  if (!wrong.empty()) {
    const fs::path kept = folder.parent_path() / "failed" / std::to_string(seed);
    fs::remove_all(kept);
    fs::create_directories(kept.parent_path());
    fs::copy(folder, kept, fs::copy_options::recursive);
    std::ofstream(kept / "said.txt") << said;
    std::ofstream(kept / "wrong.txt") << fmt::format("{}\n", fmt::join(wrong, "\n"));
  }
  return played;
}

std::set<int> seeds_played(const fs::path& table) {
  std::set<int> seeds;
  std::ifstream rows(table);
  for (std::string row; std::getline(rows, row);) {
    if (!row.empty() && row[0] >= '0' && row[0] <= '9') seeds.insert(std::stoi(row));
  }
  return seeds;
}

PlannedSignatures undisturbed_game(const fs::path& scenario, const fs::path& folder) {
  if (!fs::exists(folder / "game" / "complete")) {
    fs::remove_all(folder);
    PlayedGame game(scenario, folder, "game");
    if (!game.play_to_end(kPatienceS) || game.status() != 0) {
      throw InputError::format("the undisturbed game does not end well: {}", game.said());
    }
    std::ofstream(folder / "game" / "complete") << "yes\n";
  }
  return planned_signatures_of(folder / "game");
}

int run_campaign(const Options& options) {
  fs::create_directories(options.folder);
  const fs::path folder = fs::canonical(options.folder), scenario = folder / "campaign.toml",
                 table = folder / "games.csv";
  std::ofstream(scenario) << short_game("campaign", 1);
  const PlannedSignatures expected = undisturbed_game(scenario, folder / "undisturbed");
  if (!fs::exists(table)) std::ofstream(table) << kHead;
  const std::set<int> known = seeds_played(table);
  const auto began = Clock::now();
  const auto seconds = [&](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  int failures = 0, played_now = 0;
  for (int seed = options.first_seed; seed < options.first_seed + options.games; ++seed) {
    if (known.contains(seed)) continue;
    if (options.seconds > 0.0 && seconds(began) > options.seconds) break;
    const auto start = Clock::now();
    Played game = play(static_cast<std::uint64_t>(seed), scenario, folder / "now", expected);
    FaultCounts& n = game.counts;
    std::ofstream(table, std::ios::app) << fmt::format(
        "{},\"{}\",{:.1f},{},{},{},{},{},{},{},{},\"{}\"\n", seed,
        game.verdict.substr(0, game.verdict.find_first_of("\"\n")), seconds(start), n["killed"], n["stopped"],
        n["database locked"], n["disk full"], n["everything killed"], game.resumed, game.traces.measured.size(),
        game.traces.simulations.size(), game.settings);
    ++played_now;
    failures += game.verdict != "same";
    fmt::print(
        "game {}: {} ({:.1f} s; killed {}, stopped {}, locked {}, disk full {}, all killed {}, resumed {}; {})\n", seed,
        game.verdict, seconds(start), n["killed"], n["stopped"], n["database locked"], n["disk full"],
        n["everything killed"], game.resumed, game.settings);
    std::fflush(stdout);
  }
  fmt::print("{} games now, {} before; {} differ\n", played_now, known.size(), failures);
  return failures == 0 && played_now + static_cast<int>(known.size()) > 0 ? 0 : 1;
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  CLI::App app("Short games under seeded faults, compared with the undisturbed game");
  nacre::Options options;
  app.add_option("--folder", options.folder, "Where games and their table are kept")->capture_default_str();
  app.add_option("--games", options.games, "Seeds to play")->check(CLI::Range(1, 1'000'000))->capture_default_str();
  app.add_option("--first-seed", options.first_seed, "The first of them")->capture_default_str();
  app.add_option("--seconds", options.seconds, "Begin no game after so many seconds; 0: play all");
  CLI11_PARSE(app, argc, argv);
  try {
    return nacre::run_campaign(options);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 2;
  }
}
