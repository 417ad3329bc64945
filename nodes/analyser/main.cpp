// The analyser as a process.

#include "analyser/analyser_core.hpp"
#include "analyser/works.hpp"
#include "runtime/node_shell.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  return runtime::node_main(argc, argv, "analyser",
                            [](const runtime::NodeOptions& options, const game::Scenario& scenario) {
                              // One piece of work at a time: messages are kept in order, and a diagnosis uses all cores
                              // by itself.
                              return runtime::NodeProgram{.core = analyser::make_core(scenario),
                                                          .work = analyser::work_functions(options.run_dir),
                                                          .default_threads = 1};
                            });
}
