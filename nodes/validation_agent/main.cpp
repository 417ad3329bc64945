// The validation agent as a process.

#include "runtime/node_main.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/validation_core.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  return runtime::node_main(argc, argv, "validation_agent",
                            [](const runtime::NodeOptions& options, const game::Scenario& scenario) {
                              return runtime::NodeProgram{.core = validation_agent::make_core(scenario),
                                                          .work = validation_agent::work_functions(options.run_dir)};
                            });
}
