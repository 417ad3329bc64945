// One of the two echo nodes as a process: echo_node --node proposal_agent --run-dir DIR --port N

#include <CLI/CLI.hpp>

#include "echo_cores.hpp"
#include "runtime/node_main.hpp"

int main(int argc, char** argv) {
  CLI::App app("echo node");
  nacre::runtime::NodeOptions options;
  nacre::runtime::add_node_options(app, options);
  app.add_option("--node", options.node)->required();
  CLI11_PARSE(app, argc, argv);
  options.participants = nacre::echo::kParticipants;
  options.threads = 2;
  auto core = nacre::echo::make_core(options.node);
  return nacre::runtime::run_node(std::move(options), std::move(core), nacre::echo::echo_functions());
}
