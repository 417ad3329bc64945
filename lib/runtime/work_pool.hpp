#pragma once
// Threads for long work. Results are collected by the shell, in the order in which they finish.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "runtime/node_core.hpp"

namespace nacre::runtime {

/// What became of a Compute.
struct FinishedWork {
  Compute compute;
  Result<std::string> result;  ///< the error: the function threw
};

class WorkPool {
 public:
  /// `threads` 0: all allowed cores. `wake` is called from a worker whenever a result is ready.
  WorkPool(std::map<std::string, WorkFunction> functions, int threads, std::function<void()> wake);
  /// Work that is still running is left to the end of the process: it has no effects.
  ~WorkPool();
  bool knows(const std::string& kind) const;
  void start(Compute compute);
  std::vector<FinishedWork> finished();
  /// Asked for and not yet collected by finished().
  int pending() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace nacre::runtime
