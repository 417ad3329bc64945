// The simulator farm as a process.

#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "runtime/node_shell.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/simulate_work.hpp"

int main(int argc, char** argv) {
  using namespace nacre;
  std::filesystem::path cache_file;
  const auto make = [&](const runtime::NodeOptions& options, const game::Scenario& scenario) {
    // Shared by all runs beside this one: the answers do not depend on the run.
    if (cache_file.empty())
      cache_file = std::filesystem::absolute(options.run_dir).lexically_normal() / ".." / "simulations.db";
    auto cache = std::make_shared<store::SimulationCache>(cache_file.lexically_normal());
    return runtime::NodeProgram{.core = simulator_farm::make_core(scenario),
                                .work = simulator_farm::work_functions(std::move(cache), options.run_dir / "films"),
                                .default_threads = scenario.farm_threads};
  };
  return runtime::node_main(argc, argv, "simulator_farm", make, [&](CLI::App& app) {
    app.add_option("--cache", cache_file, "Cache of simulations (default: simulations.db beside the run's folder)");
  });
}
