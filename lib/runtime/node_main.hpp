#pragma once
// The main of every node: command line, scenario, core, shell.

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "runtime/executor.hpp"
#include "runtime/node_core.hpp"
#include "runtime/node_shell.hpp"

namespace CLI {
class App;
}
namespace nacre::game {
struct Scenario;
}

namespace nacre::runtime {

/// What a node's main makes of options and scenario.
struct NodeProgram {
  std::unique_ptr<NodeCore> core;
  std::map<std::string, WorkFunction> work;
  int default_threads = 0;     ///< for long work when --threads is not given; 0 all allowed cores
  MakeExecutor executor = {};  ///< instead of threads, or where threads need what no second process may open
};
using MakeNode = std::function<NodeProgram(const NodeOptions&, const game::Scenario&)>;

/// A node's whole main: command line, the run's folder, scenario, core, run_node. InputError becomes a sentence and
/// exit status 2, a full disk one and 1. `add_options` may add options of the node's own.
int node_main(int argc, char** argv, const std::string& node, const MakeNode& make,
              const std::function<void(CLI::App&)>& add_options = {});

/// The options of NodeOptions, as node_main() adds them.
void add_node_options(CLI::App& app, NodeOptions& options);

}  // namespace nacre::runtime
