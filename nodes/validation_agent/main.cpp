// The validation agent as a process.

#include "runtime/node_shell.hpp"
#include "validation_agent/validation_core.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  return runtime::node_main(argc, argv, "validation_agent",
                            [](const runtime::NodeOptions&, const game::Scenario& scenario) {
                              return runtime::NodeProgram{.core = validation_agent::make_core(scenario), .work = {}};
                            });
}
