#pragma once
// Plays a run: folder, port, recorder, nodes, readiness, restarts, orderly end.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/restart_budget.hpp"

namespace nacre::runtime {

struct LaunchOptions {
  std::filesystem::path scenario;             ///< of a new run; empty when `resume` is given
  std::filesystem::path resume;               ///< folder of a run to go on with
  std::string run_name;                       ///< empty: date-time-scenario
  std::optional<std::filesystem::path> logs;  ///< where a new run is kept; default logs
  std::optional<int> port;                    ///< instead of the scenario's
  std::optional<std::uint64_t> seed;          ///< instead of the scenario's
  std::filesystem::path program_folder;       ///< of nacre_NODE; empty: beside this program
  std::filesystem::path nacre;                ///< program whose `record` is the recorder; empty: this program
  RestartBudget::Settings restarts;
  int max_log_mb = 0;                  ///< after which run.lcm goes on in another piece; 0: one file
  bool dashboard = false;              ///< show the run in the browser while it plays
  std::vector<std::string> elsewhere;  ///< nodes of the run that another machine starts (hosts = "lan")
  std::vector<std::string> debug;      ///< nodes that wait for a debugger at their start
  std::vector<std::string> only;       ///< join with these nodes a run that another machine has launched
};

/// Plays the game until its last round, Ctrl-C (SIGINT, SIGTERM, SIGHUP) or the failure of a node for good. Exit
/// status: 0 the game was played to its end, 1 it was stopped before or a node failed. Throws InputError for what a
/// person has to mend first. With `only`, `resume` is the run's folder, shared or copied: neither recorder nor RUN come
/// from here, and the end is that these nodes have finished and nobody who still plays reports.
int launch(const LaunchOptions& options);

}  // namespace nacre::runtime
