// The virtual laboratory as a process. It seals its truth in RUN/laboratory.truth.toml for whoever scores the run
// afterwards.

#include "laboratory/laboratory_file.hpp"
#include "runtime/node_main.hpp"
#include "virtual_lab/virtual_lab_core.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  const auto make = [](const runtime::NodeOptions& options, const game::Scenario& scenario) {
    const laboratory::Truth truth = virtual_lab::truth_of(scenario);
    laboratory::write_sealed(options.run_dir / "laboratory.truth.toml", truth);
    return runtime::NodeProgram{.core = std::make_unique<virtual_lab::VirtualLabCore>(truth),
                                .work = virtual_lab::work_functions(truth)};
  };
  return runtime::node_main(argc, argv, "virtual_lab", make);
}
