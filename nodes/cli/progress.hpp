#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace nacre::cli {

/// Progress of a long command on standard error: one live line with the time left on a terminal, a plain line every few
/// seconds elsewhere. Quick work says nothing. Thread-safe.
class Progress {
 public:
  /// `total` things to do; 0 when only a share of the whole is known.
  explicit Progress(std::string task, std::int64_t total = 0);
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `count` more of the total are done.
  void advance(std::int64_t count = 1);
  /// So many of the total are done.
  void set(std::int64_t done);
  /// A share of 0..1 is done; `note` says what is being done.
  void set_share(double share, const std::string& note);
  /// Removes the live line.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  void show();
  std::string line() const;

  std::string task_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  double share_ = 0.0;
  std::string note_;
  int columns_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point shown_ = Clock::now();
  bool is_drawn_ = false;
  std::mutex mutex_;
};

}  // namespace nacre::cli
