// The proposal agent as a process.

#include "proposal_agent/proposal_core.hpp"
#include "proposal_agent/selection_work.hpp"
#include "runtime/node_main.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  return runtime::node_main(argc, argv, "proposal_agent",
                            [](const runtime::NodeOptions&, const game::Scenario& scenario) {
                              // One selection at a time: the farm needs the cores.
                              return runtime::NodeProgram{.core = proposal_agent::make_core(scenario),
                                                          .work = proposal_agent::work_functions(),
                                                          .default_threads = 1};
                            });
}
