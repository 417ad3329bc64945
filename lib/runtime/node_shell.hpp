#pragma once
// The shell around a pure core: bus, journal, reliable delivery, worker threads, text log, orderly stop.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/executor.hpp"
#include "runtime/node_core.hpp"

namespace nacre::runtime {

/// The command line that all nodes share.
struct NodeOptions {
  std::string node;                     ///< name of the node, e.g. validation_agent
  std::filesystem::path run_dir;        ///< --run-dir: logs/RUN
  std::filesystem::path scenario_file;  ///< --scenario; default RUN_DIR/scenario.toml
  std::string run_id;         ///< --run-id, as the manifest says; empty for run_node(): the last part of run_dir
  int port = 0;               ///< --port of the run's bus
  int threads = 0;            ///< --threads for long work; 0 all allowed cores
  std::int64_t epoch = 0;     ///< --epoch; 0: now
  bool lan = false;           ///< the run spans hosts (from the scenario)
  bool follow_parent = true;  ///< --detached turns it off: else the node ends when the process that started it does
  bool wait_for_debugger = false;         ///< --wait-for-debugger: before anything else
  std::vector<std::string> participants;  ///< nodes of the run (from the scenario)
  std::string url;                        ///< --url overrides port; for tests

  std::filesystem::path node_dir() const { return run_dir / "nodes" / node; }
};

/// Signals that would end the process at a failed write leave an error in their place, which is handled.
void turn_write_signals_into_errors();

/// Runs the node until SIGINT or SIGTERM. Journal and text log stand in RUN_DIR/nodes/NODE. Returns the exit status: 0
/// stopped in order, 1 something failed that may pass (disk full, an output that breaks the rules), 2 bad input
/// (journal damaged or in use, a core that no longer reproduces its journal, no multicast). The sentence goes to
/// standard error and the text log. Long work is done by `executor`, which is made once the journal is locked, so that
/// a second process of the node is refused before it has one; without it, by `work` on threads of this process.
int run_node(NodeOptions options, std::unique_ptr<NodeCore> core, std::map<std::string, WorkFunction> work,
             const MakeExecutor& executor = {});

}  // namespace nacre::runtime
