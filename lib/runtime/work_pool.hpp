#pragma once
// Threads for long work. Results are collected by the shell, in the order in which they finish.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/executor.hpp"

namespace nacre::runtime {

/// The executor of one machine. Work whose function throws is an error.
class WorkPool : public Executor {
 public:
  /// `threads` 0: all allowed cores. `wake` is called from a worker whenever a result is ready.
  WorkPool(std::map<std::string, WorkFunction> functions, int threads, std::function<void()> wake);
  /// Work that is still running is left to the end of the process: it has no effects.
  ~WorkPool() override;
  bool knows(const std::string& kind) const override;
  void start(Compute compute) override;
  std::vector<FinishedWork> finished() override;
  int pending() const override;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace nacre::runtime
