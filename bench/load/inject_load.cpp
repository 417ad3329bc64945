#include <signal.h>

#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "base/result.hpp"
#include "latencies.hpp"
#include "loads.hpp"
#include "made_up.hpp"
#include "measurement/write_set.hpp"
#include "runtime/process.hpp"

namespace nacre::load {
namespace {

constexpr const char* kScenario = R"(name = "load"
rounds = 1
fidelity = "tiny"
[proposal]
samples = 10
seeds = 1
population = 5
designs = 1
[validation]
random_patterns = 2
calibration_evaluations = 3
modulus_evaluations = 6
mixtures = [0.5]
[diagnosis]
enabled = false
[laboratory]
virtual_lab = false
)";

std::string nacre_program() { return (runtime::this_program().parent_path() / "nacre").string(); }

/// Reads what the game says until it waits for measurements.
void wait_for_orders(runtime::ChildProcess& game) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  while (std::chrono::steady_clock::now() < end && !game.poll_end()) {
    for (const std::string& line : game.read_lines()) {
      if (line.find("orders for the laboratory") != std::string::npos) return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw InputError("the game does not get as far as its first orders");
}

double memory_mb_of(const std::string& program, const std::filesystem::path& run) {
  const std::string pids = runtime::ask_program({"pgrep", "-f", program + ".*" + run.filename().string()}).output;
  std::ifstream status(fmt::format("/proc/{}/status", pids.substr(0, pids.find('\n'))));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}

}  // namespace

void load_injection(const Options& options) {
  const std::filesystem::path scenario = options.folder / "load.toml", set = options.folder / "set",
                              run = options.folder / "load-run";
  std::ofstream(scenario) << kScenario;
  RandomStream random(options.seed, "load/inject");
  measurement::write_measurement_set(set, made_up_specimens(options.measurements, options.designs, random));
  runtime::ChildProcess game({nacre_program(), "launch", scenario.string(), "--logs", options.folder.string(), "--run",
                              run.filename().string()});
  wait_for_orders(game);
  Latencies injecting, asking;
  runtime::ProgramOutput answer;
  std::atomic<bool> injected = false;
  std::thread injector([&] {
    injecting.time([&] {
      answer =
          runtime::ask_program({nacre_program(), "inject", set.string(), "--run", run.string(), "--timeout-s", "600"});
    });
    injected = true;
  });
  const auto ask = [&] { runtime::ask_program({nacre_program(), "designs", "--run", run.string(), "--json"}); };
  while (!injected) {
    game.read_lines();
    asking.time(ask);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  injector.join();
  injecting.print(fmt::format("game: inject {} specimens", options.measurements));
  asking.print("game: nacre designs meanwhile");
  Latencies afterwards;
  for (int i = 0; i < 20; ++i) afterwards.time(ask);
  afterwards.print("game: nacre designs afterwards");
  fmt::print("game: inject said: {}\n", answer.output.substr(0, 300));
  for (const char* node : {"nacre_validation_agent", "nacre_analyser", "nacre_proposal_agent", "nacre_simulator_farm"})
    fmt::print("game: {} held at most {:.0f} MB\n", node, memory_mb_of(node, run));
  game.signal_group(SIGINT);
  while (!game.poll_end()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace nacre::load
