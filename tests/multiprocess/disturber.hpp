#pragma once
// What goes wrong while a game plays, drawn from a seed: processes killed and stopped, databases locked, the disk full,
// and through NACRE_FAULTS a bad network and clocks that are set.

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "played_game.hpp"

namespace SQLite {
class Database;
}

namespace nacre {

/// How often each kind of fault happened.
using FaultCounts = std::map<std::string, int>;

class Disturber {
 public:
  /// `disk_can_fill`: the game's folder lies on a small file system of its own.
  Disturber(std::uint64_t seed, const std::filesystem::path& run, bool disk_can_fill);
  ~Disturber();

  /// NACRE_FAULTS of the game: up to 40 % of the datagrams lost, some doubled, overtaken, damaged; clocks that jump by
  /// up to a day.
  std::string network_and_clock() const;

  /// To be called some 50 times a second while the game plays: begins and ends faults.
  void disturb(PlayedGame& game);
  /// The launcher is to be killed now, with everything.
  bool wants_everything_killed();
  /// Ends what is going on: stopped processes run, locks are given back, the disk has room.
  void relent();

  const FaultCounts& counts() const { return counts_; }

 private:
  using Clock = std::chrono::steady_clock;
  void begin_fault(PlayedGame& game);
  void kill_node(PlayedGame& game);
  void stop_node(PlayedGame& game);
  void lock_database();
  void fill_disk();
  std::string any_node();
  Clock::time_point after(double shortest_s, double longest_s);

  RandomStream random_;
  std::filesystem::path run_;
  bool disk_can_fill_;
  std::string settings_;
  FaultCounts counts_;
  int faults_ = 0;  ///< begun, or tried
  Clock::time_point next_;
  bool kill_everything_ = false;
  std::vector<std::pair<int, Clock::time_point>> stopped_;  ///< process, until when
  std::unique_ptr<SQLite::Database> lock_;
  Clock::time_point unlock_;
  bool disk_is_full_ = false;
  Clock::time_point room_;
};

}  // namespace nacre
