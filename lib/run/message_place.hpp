#pragma once
// Where a message belongs in a game: its round.

#include <optional>
#include <string>
#include <string_view>

#include "wire/convert.hpp"

namespace nacre::run {

/// The rounds that are over at some moment.
class ClosedRounds {
 public:
  void close(int round, bool is_last);
  /// The one that is being measured: the newest closed one + 1, but none follows the last.
  int measuring() const { return is_over_ ? newest_ : newest_ + 1; }

 private:
  int newest_ = -1;
  bool is_over_ = false;
};

/// The round that a message speaks of: its own, or that of the analyser's request which it responds to
/// (`analyser/rN/...`); nothing for others.
std::optional<int> round_of(std::string_view channel, const std::string& payload);

/// The round that a specimen was measured in: that of its order, else the one that was measured when it came.
int measured_in(const wire::Measurement& measured, const ClosedRounds& closed);

}  // namespace nacre::run
