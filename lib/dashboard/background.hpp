#pragma once
// Work that takes seconds, done on a thread of its own: asked for once, polled until it is there.

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/result.hpp"

namespace nacre::dashboard {

/// One thread and its results; the newest are kept, by key.
class Background {
 public:
  /// Makes the result, and reports its progress, 0..1, to the function it is given.
  using Work = std::function<Result<std::string>(const std::function<void(double)>& progress)>;

  enum class Stage { unknown, queued, working, ready, failed };
  struct State {
    Stage stage = Stage::unknown;
    double progress = -1.0;                          ///< 0..1 while working, -1 unknown
    double working_s = 0.0;                          ///< so far
    std::shared_ptr<const std::string> result = {};  ///< when ready
    std::string problem = {};                        ///< when failed
  };

  /// Keeps `kept` results, and lets at most `longest_queue` tasks wait.
  explicit Background(std::size_t kept = 24, std::size_t longest_queue = 8);
  ~Background();

  /// Puts work into the queue unless it is known under this key; failed work is tried again. False when the queue is
  /// full.
  bool ask(const std::string& key, Work work);
  State state(const std::string& key) const;

 private:
  struct Task;
  void run();
  void forget_oldest();
  std::size_t kept_, longest_queue_;
  mutable std::mutex mutex_;
  std::condition_variable something_to_do_;
  std::map<std::string, std::shared_ptr<Task>> tasks_;
  std::deque<std::string> queue_, done_;
  bool stopping_ = false;
  std::thread thread_;
};

std::string_view to_string(Background::Stage stage);

}  // namespace nacre::dashboard
