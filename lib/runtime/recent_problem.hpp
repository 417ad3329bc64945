#pragma once

#include <cstdint>
#include <string>

namespace nacre::runtime {

/// The problem that a node's STATUS shows: one of the last minute, so that nobody takes an old one for new. The log
/// keeps them all. Time is passed in, in microseconds.
class RecentProblem {
 public:
  void note(const std::string& text, std::int64_t now_us) {
    constexpr std::size_t kLongest = 500;
    text_ = text.substr(0, kLongest);
    noted_us_ = now_us;
  }
  /// Empty when there is none, or none that is recent.
  std::string shown(std::int64_t now_us) const {
    constexpr std::int64_t kShownUs = 60'000'000;
    return now_us - noted_us_ < kShownUs ? text_ : "";
  }

 private:
  std::string text_;
  std::int64_t noted_us_ = 0;
};

}  // namespace nacre::runtime
