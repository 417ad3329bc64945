// The virtual laboratory as a process. It seals its truth in RUN/laboratory.truth.toml for whoever scores the run
// afterwards.

#include "runtime/node_shell.hpp"
#include "virtual_lab/virtual_lab_core.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  const auto make = [](const runtime::NodeOptions& options, const game::Scenario& scenario) {
    const virtual_laboratory::Truth truth = virtual_laboratory::truth_of(scenario);
    virtual_laboratory::write_sealed(options.run_dir / "laboratory.truth.toml", truth);
    return runtime::NodeProgram{.core = std::make_unique<virtual_laboratory::VirtualLabCore>(truth),
                                .work = virtual_laboratory::work_functions(truth)};
  };
  return runtime::node_main(argc, argv, "virtual_lab", make);
}
