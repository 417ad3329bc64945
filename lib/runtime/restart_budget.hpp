#pragma once

#include <chrono>
#include <deque>

namespace nacre::runtime {

/// How often a node may be started again: at most `most` times within any `window`, each after `delay`. Time is passed
/// in.
class RestartBudget {
 public:
  using Clock = std::chrono::steady_clock;
  struct Settings {
    int most = 5;
    Clock::duration window = std::chrono::seconds(60);
    Clock::duration delay = std::chrono::milliseconds(500);
  };

  explicit RestartBudget(const Settings& settings) : settings_(settings) {}

  /// Asks for one restart after a death at `now`; true and counted when the budget allows it.
  bool take(Clock::time_point now) {
    while (!taken_.empty() && now - taken_.front() >= settings_.window) taken_.pop_front();
    if (static_cast<int>(taken_.size()) >= settings_.most) return false;
    taken_.push_back(now);
    return true;
  }
  Clock::duration delay() const { return settings_.delay; }

 private:
  Settings settings_;
  std::deque<Clock::time_point> taken_;
};

}  // namespace nacre::runtime
