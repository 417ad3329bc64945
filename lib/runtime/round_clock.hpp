#pragma once
// How long a game still takes, from the rounds that have gone by.

#include <chrono>
#include <optional>

namespace nacre::runtime {

/// Times rounds as they begin. A round is as long as the one before it: round 0, which prepares the first one, tells
/// nothing, and so does a round of which the beginning was not seen.
class RoundClock {
 public:
  using Clock = std::chrono::steady_clock;
  /// The game is in this round now.
  void see(int round, Clock::time_point now);
  /// Seconds left of the present round, and of the game whose last round is `last_round`; nothing before a whole round
  /// has been timed, or when the present one takes longer than that.
  std::optional<double> round_left_s(Clock::time_point now) const;
  std::optional<double> game_left_s(int last_round, Clock::time_point now) const;

 private:
  int round_ = -1;
  std::optional<Clock::time_point> begun_;  ///< of the round, where that was seen
  std::optional<double> length_s_;          ///< of the last whole one
};

}  // namespace nacre::runtime
