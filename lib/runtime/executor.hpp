#pragma once
// What carries out a node's long work. The shell knows no more of it than this: threads of this process
// (work_pool.hpp), tasks of a cluster, an accelerator.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "runtime/node_core.hpp"

namespace nacre::runtime {

/// What became of a Compute.
struct FinishedWork {
  Compute compute;
  Result<std::string> result;  ///< the error stops the node
};

/// Takes work and gives results, in any order; called from the shell's thread. Work without a result is given again
/// after a restart of the node, so an executor need not remember it, and may.
class Executor {
 public:
  virtual ~Executor() = default;
  virtual bool knows(const std::string& kind) const = 0;
  virtual void start(Compute compute) = 0;
  /// The results since the last call.
  virtual std::vector<FinishedWork> finished() = 0;
  /// Asked for and not yet collected by finished().
  virtual int pending() const = 0;
  /// Lines for the node's text log since the last call.
  virtual std::vector<LogLine> take_log() { return {}; }
  /// How the work stands, for people, in a few words; empty when pending() says it all.
  virtual std::string standing() const { return {}; }
};

/// Makes an executor that calls `wake` (from any thread) whenever a result or a line is ready.
using MakeExecutor = std::function<std::unique_ptr<Executor>(std::function<void()> wake)>;

}  // namespace nacre::runtime
