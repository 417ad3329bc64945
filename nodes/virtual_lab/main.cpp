// The virtual laboratory as a process. It seals its truth in RUN/laboratory.truth.toml for whoever scores the run
// afterwards.

#include "laboratory/laboratory_file.hpp"
#include "runtime/node_main.hpp"
#include "virtual_lab/kept_responses.hpp"
#include "virtual_lab/virtual_lab_core.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  const auto make = [](const runtime::NodeOptions& options, const game::Scenario& scenario) {
    const laboratory::Truth truth = virtual_lab::truth_of(scenario);
    laboratory::write_sealed(options.run_dir / "laboratory.truth.toml", truth);
    std::map<std::string, runtime::WorkFunction> work = virtual_lab::work_functions(truth);
    const std::filesystem::path beside_runs = std::filesystem::absolute(options.run_dir) / "..";
    for (auto& [kind, function] : work)
      function =
          virtual_lab::kept(std::move(function), truth, (beside_runs / virtual_lab::kKeptFolder).lexically_normal());
    return runtime::NodeProgram{.core = std::make_unique<virtual_lab::VirtualLabCore>(truth), .work = std::move(work)};
  };
  return runtime::node_main(argc, argv, "virtual_lab", make);
}
