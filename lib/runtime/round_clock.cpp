#include "runtime/round_clock.hpp"

namespace nacre::runtime {
namespace {

double seconds_between(RoundClock::Clock::time_point from, RoundClock::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

void RoundClock::see(int round, Clock::time_point now) {
  if (round <= round_) return;
  const bool follows = round_ >= 0 && round == round_ + 1;
  if (follows && round_ > 0 && begun_) length_s_ = seconds_between(*begun_, now);
  begun_ = follows ? std::optional(now) : std::nullopt;
  round_ = round;
}

std::optional<double> RoundClock::round_left_s(Clock::time_point now) const {
  if (!length_s_ || !begun_) return std::nullopt;
  const double left = *length_s_ - seconds_between(*begun_, now);
  return left > 0.0 ? std::optional(left) : std::nullopt;
}

std::optional<double> RoundClock::game_left_s(int last_round, Clock::time_point now) const {
  const std::optional<double> round_left = round_left_s(now);
  if (!round_left || round_ > last_round) return std::nullopt;
  return *round_left + *length_s_ * (last_round - round_);
}

}  // namespace nacre::runtime
