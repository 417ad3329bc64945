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
  Progress(std::string task, std::int64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `count` more of the total are done.
  void advance(std::int64_t count = 1);
  /// So many are done, of a total that may have changed, with a remark ("best error 8 %").
  void set(std::int64_t done, std::int64_t total, const std::string& note = "");

 private:
  using Clock = std::chrono::steady_clock;
  void show();
  std::string line() const;

  std::string task_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  std::string note_;
  int columns_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point shown_ = Clock::now();
  bool is_drawn_ = false;
  std::mutex mutex_;
};

}  // namespace nacre::cli
