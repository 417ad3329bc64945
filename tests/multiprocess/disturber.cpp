#include "disturber.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "program.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestPauseS = 1.5;  // between two faults
// Then the game is left alone: on a machine that is slow to start processes, faults without end would leave no time to
// play.
constexpr int kMostFaults = 25;

std::string drawn_settings(RandomStream& random, std::uint64_t seed) {
  const auto share = [&](double most) { return random.uniform() < 0.7 ? random.uniform(0.0, most) : 0.0; };
  const double drop = share(0.4), duplicate = share(0.2), reorder = share(0.2), corrupt = share(0.1);
  constexpr double kDayS = 86'400.0;
  const double clock_s = random.uniform() < 0.5 ? random.uniform(1.0, kDayS) : 0.0;
  return fmt::format("seed={},drop={:.3f},duplicate={:.3f},reorder={:.3f},corrupt={:.3f},clock={:.0f}", seed, drop,
                     duplicate, reorder, corrupt, clock_s);
}

}  // namespace

Disturber::Disturber(std::uint64_t seed, const fs::path& run, bool disk_can_fill)
    : random_(seed, "disturber"),
      run_(run),
      disk_can_fill_(disk_can_fill),
      settings_(drawn_settings(random_, seed)),
      next_(after(0.2, kLongestPauseS)) {}

Disturber::~Disturber() { relent(); }

std::string Disturber::network_and_clock() const { return settings_; }

Disturber::Clock::time_point Disturber::after(double shortest_s, double longest_s) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(random_.uniform(shortest_s, longest_s)));
}

void Disturber::disturb(PlayedGame& game) {
  const auto now = Clock::now();
  std::erase_if(stopped_,
                [&](const auto& process) { return now >= process.second && (::kill(process.first, SIGCONT), true); });
  if (lock_ && now >= unlock_) lock_.reset();
  if (disk_is_full_ && now >= room_) {
    fs::remove(run_.parent_path() / "ballast");
    disk_is_full_ = false;
  }
  if (now < next_ || faults_ == kMostFaults) return;
  ++faults_;
  begin_fault(game);
  next_ = after(0.1, kLongestPauseS);
}

void Disturber::begin_fault(PlayedGame& game) {
  const double draw = random_.uniform();
  if (draw < 0.4) return kill_node(game);
  if (draw < 0.65) return stop_node(game);
  if (draw < 0.8) return lock_database();
  if (draw < 0.92) return fill_disk();
  kill_everything_ = true;
}

bool Disturber::wants_everything_killed() {
  if (!kill_everything_) return false;
  kill_everything_ = false;
  ++counts_["everything killed"];
  return true;
}

std::string Disturber::any_node() { return kGameNodes[random_.index(static_cast<int>(kGameNodes.size()))]; }

void Disturber::kill_node(PlayedGame& game) {
  const int process = game.process_of(any_node());
  if (process != 0 && ::kill(process, SIGKILL) == 0) ++counts_["killed"];
}

void Disturber::stop_node(PlayedGame& game) {
  const int process = game.process_of(any_node());
  if (process == 0 || ::kill(process, SIGSTOP) != 0) return;
  ++counts_["stopped"];
  stopped_.emplace_back(process, after(0.2, 4.0));
}

/// As somebody's SQLite tool would, in the midst of a long transaction.
void Disturber::lock_database() {
  const fs::path file = random_.uniform() < 0.5 ? run_ / "run.db" : run_.parent_path() / "simulations.db";
  if (lock_ || disk_is_full_ || !fs::exists(file)) return;
  try {
    auto database = std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE, 100);
    database->exec("BEGIN IMMEDIATE");
    lock_ = std::move(database);
  } catch (const SQLite::Exception&) {
    return;  // somebody is writing
  }
  ++counts_["database locked"];
  unlock_ = after(0.2, 5.0);
}

void Disturber::fill_disk() {
  if (!disk_can_fill_ || disk_is_full_ || lock_) return;
  const fs::path ballast = run_.parent_path() / "ballast";
  const int fd = ::open(ballast.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (fd < 0) return;
  const std::string bytes(4096, 'x');
  while (::write(fd, bytes.data(), bytes.size()) > 0) {
  }
  ::close(fd);
  ++counts_["disk full"];
  disk_is_full_ = true;
  room_ = after(0.2, 3.0);
}

void Disturber::relent() {
  for (const auto& [process, until] : stopped_) ::kill(process, SIGCONT);
  stopped_.clear();
  lock_.reset();
  if (disk_is_full_) fs::remove(run_.parent_path() / "ballast");
  disk_is_full_ = false;
}

}  // namespace nacre
