#pragma once
// Records everything on the bus of a run in RUN/run.lcm, for people: bursts without loss, flushed on a timer, gaps
// reported, in pieces where that is wanted.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "runtime/bus.hpp"

namespace nacre::runtime {

struct RecorderOptions {
  std::filesystem::path log;    ///< its last piece is appended to when it exists (a torn tail is cut off)
  std::int64_t most_bytes = 0;  ///< of a piece, beside the repeated state; 0: one file (log_pieces.hpp)
  std::string url;
  double flush_every_s = 0.2;
  std::function<void(LogLevel, const std::string&)> report = {};
  std::function<void()> ready = {};  ///< nothing that is published from now on is missed
};

struct RecorderCounters {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t lost = 0;     ///< gaps in publishers' sequence numbers
  std::int64_t unnamed = 0;  ///< messages without a channel, not recorded
};

/// A recorder that the launcher pumps, or that runs in a thread or process of its own.
class Recorder {
 public:
  /// Throws InputError: file not writable, no multicast.
  explicit Recorder(RecorderOptions options);
  ~Recorder();
  /// Records what arrives within timeout_ms. The error: the disk is full.
  Result<void> pump(int timeout_ms);
  RecorderCounters counters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Records until `is_over` says so. Exit status as of a node: 1 where the log cannot be written, which may pass; 2
/// where there is something to mend first.
int run_recorder(const RecorderOptions& options, const std::function<bool()>& is_over);

}  // namespace nacre::runtime
