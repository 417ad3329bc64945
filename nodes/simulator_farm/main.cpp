// The simulator farm as a process; and, as `work`, one task that it gave to a cluster.

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "base/result.hpp"
#include "gpu/cuda.hpp"
#include "runtime/node_main.hpp"
#include "runtime/process.hpp"
#include "simulator_farm/batch_task.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/gpu_executor.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "simulator_farm/slurm_executor.hpp"

namespace nacre::simulator_farm {
namespace {

namespace fs = std::filesystem;

/// What the command line says instead of the scenario.
struct FarmOptions {
  fs::path cache_file;
  std::string executor;
  double poll_s = SlurmSettings{}.poll_s;
  Patience patience;
};

void add_options(CLI::App& app, FarmOptions& options) {
  app.add_option("--cache", options.cache_file,
                 "Cache of simulations (default: simulations.db beside the run's folder)");
  app.add_option("--executor", options.executor, "Who simulates (default: farm.executor of the scenario)")
      ->check(CLI::IsMember({"local", "slurm", "cuda"}));
  app.add_option("--slurm-poll-s", options.poll_s, "Seconds between two looks at Slurm's list")
      ->check(CLI::Range(0.1, 600.0));
  app.add_option("--slurm-listing-s", options.patience.listing_s,
                 "Seconds that a result may come after Slurm stopped listing its task")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--slurm-sign-s", options.patience.sign_s,
                 "Seconds without a sign of life of a running task until its batch is given out again")
      ->check(CLI::Range(1.0, 86400.0));
}

runtime::NodeProgram make_farm(const FarmOptions& options, const runtime::NodeOptions& node,
                               const game::Scenario& scenario) {
  const fs::path run = fs::absolute(node.run_dir).lexically_normal();
  const std::string executor = options.executor.empty() ? scenario.farm.executor : options.executor;
  // Shared by all runs beside this one: results do not depend on the run. A device rounds otherwise, so that farms
  // with one have a cache of their own, for what their threads compute, too.
  const fs::path usual = run / ".." / (executor == "cuda" ? store::kDeviceCacheName : store::kCacheName);
  const fs::path file = options.cache_file.empty() ? usual : options.cache_file;
  const auto cache = std::make_shared<store::SimulationCache>(file.lexically_normal());
  runtime::NodeProgram program{.core = make_core(scenario),
                               .work = work_functions(cache, run / "films"),
                               .default_threads = scenario.farm_threads,
                               .executor = {}};
  if (executor == "cuda") {
    const GpuSettings settings{.films = run / "films",
                               .threads = node.threads > 0 ? node.threads : scenario.farm_threads,
                               .make_device = gpu::cuda_device};
    program.executor = [cache, settings](std::function<void()> wake) {
      return std::make_unique<GpuExecutor>(cache, settings, std::move(wake));
    };
  }
  if (executor == "slurm") {
    // A controller that is silent is waited for; a program that is not installed would be for ever.
    if (runtime::ask_program({"sbatch", "--version"}).end.exit_status == runtime::kProgramNotFound) {
      throw InputError(
          "executor \"slurm\": sbatch is not installed here, expected Slurm's commands in PATH (apt-get install "
          "slurm-client), or another executor");
    }
    const SlurmSettings settings{.spool = run / "slurm",
                                 .films = run / "films",
                                 .program = runtime::this_program(),
                                 .options = scenario.farm.slurm_options,
                                 .batch_s = static_cast<double>(scenario.farm.batch_s),
                                 .poll_s = options.poll_s,
                                 .patience = options.patience};
    program.executor = [cache, settings](std::function<void()> wake) {
      return std::make_unique<SlurmExecutor>(cache, settings, std::move(wake));
    };
  }
  return program;
}

/// nacre_simulator_farm work --spool DIR --wave NAME --task N
int work_main(int argc, char** argv) {
  CLI::App app("One task that a farm gave to a cluster");
  std::string spool, wave;
  int task = 0;
  app.add_option("--spool", spool, "RUN/slurm")->required();
  app.add_option("--wave", wave, "Name of the job")->required();
  app.add_option("--task", task, "Number in the job array")->required();
  try {
    app.parse(argc, argv);
    return run_batch_task(spool, wave, task);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const InputError& problem) {
    std::cerr << problem.what() << '\n';
    return 2;
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  }
}

}  // namespace
}  // namespace nacre::simulator_farm

int main(int argc, char** argv) {
  using namespace nacre;
  if (argc > 1 && std::string(argv[1]) == "work") return simulator_farm::work_main(argc - 1, argv + 1);
  simulator_farm::FarmOptions options;
  const auto make = [&](const runtime::NodeOptions& node, const game::Scenario& scenario) {
    return simulator_farm::make_farm(options, node, scenario);
  };
  return runtime::node_main(argc, argv, "simulator_farm", make,
                            [&](CLI::App& app) { simulator_farm::add_options(app, options); });
}
