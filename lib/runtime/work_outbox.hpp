#pragma once
// What an executor with threads of its own has for the shell's thread: results, lines for the log, how the work stands.

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/executor.hpp"

namespace nacre::runtime {

/// Filled by any thread, emptied by the shell's.
class WorkOutbox {
 public:
  /// `wake` is called, from the thread that puts something in, whenever there is something to collect.
  explicit WorkOutbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// One more is asked for, or so many are in other hands now.
  void expect_one();
  void pass_on(int count);

  void finish(Compute compute, Result<std::string> result);
  void say(LogLevel level, std::string text);
  void set_standing(std::string standing);
  void wake() const { wake_(); }

  // As Executor's.
  std::vector<FinishedWork> finished();
  int pending() const;
  std::vector<LogLine> take_log();
  std::string standing() const;

 private:
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::vector<FinishedWork> finished_;
  std::vector<LogLine> log_;
  std::string standing_;
  int pending_ = 0;
};

}  // namespace nacre::runtime
