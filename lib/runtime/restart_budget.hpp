#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace nacre::runtime {

/// How often a node that dies is started again, and when: each time it waits twice as long, so that what passes within
/// a minute (a full disk) ends no game, and a node that can never work is given up soon after. A node that has lived
/// for a while has a new budget. Time is passed in.
class RestartBudget {
 public:
  using Clock = std::chrono::steady_clock;
  struct Settings {
    int most = 8;  ///< restarts in a row
    Clock::duration first_wait = std::chrono::milliseconds(500);
    Clock::duration longest_wait = std::chrono::seconds(30);
    Clock::duration settled_after = std::chrono::seconds(20);  ///< a life this long ends the row
  };

  explicit RestartBudget(const Settings& settings) : settings_(settings) {}

  /// Asks for one restart after a death at `now`: how long to wait for it; nothing when the budget is used up.
  std::optional<Clock::duration> take(Clock::time_point now) {
    if (restart_at_ && now - *restart_at_ >= settings_.settled_after) in_a_row_ = 0;
    if (in_a_row_ >= settings_.most) return std::nullopt;
    wait_ = in_a_row_++ == 0 ? settings_.first_wait : std::min(2 * wait_, settings_.longest_wait);
    restart_at_ = now + wait_;
    return wait_;
  }

 private:
  Settings settings_;
  int in_a_row_ = 0;
  Clock::duration wait_{};
  std::optional<Clock::time_point> restart_at_;  ///< when its present life began; nothing: its first one
};

}  // namespace nacre::runtime
