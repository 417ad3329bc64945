// Part of the command line (command.hpp): nacre replay, a recorded game through one node again, and whether it says the
// same.

#include <filesystem>
#include <string>
#include <vector>

#include "analyser/analyser_core.hpp"
#include "analyser/works.hpp"
#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/result.hpp"
#include "base/temporary_folder.hpp"
#include "command.hpp"
#include "game/scenario.hpp"
#include "output.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "proposal_agent/selection_work.hpp"
#include "replay_laboratory.hpp"
#include "runtime/node_main.hpp"
#include "runtime/replay.hpp"
#include "runtime/run_folder.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "store/simulation_cache.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

struct ReplayOptions {
  std::string run = "logs/latest";
  std::string node;
  std::string scenario;
  bool recompute = false;
  bool json = false;
};

/// The node as its own program makes it, except that its work writes into the scratch folder and its cache begins
/// empty.
runtime::NodeProgram make_node(const std::string& node, const game::Scenario& scenario, const fs::path& scratch) {
  if (node == "validation_agent")
    return {.core = validation_agent::make_core(scenario), .work = validation_agent::work_functions(scratch)};
  if (node == "proposal_agent") {
    return {.core = proposal_agent::make_core(scenario), .work = proposal_agent::work_functions()};
  }
  if (node == "analyser") return {.core = analyser::make_core(scenario), .work = analyser::work_functions(scratch)};
  if (node == "simulator_farm") {
    return {.core = simulator_farm::make_core(scenario),
            .work = simulator_farm::work_functions(std::make_shared<store::SimulationCache>(scratch / "simulations.db"),
                                                   scratch / "films")};
  }
  return make_laboratory(scenario);
}

void print_report(const runtime::ReplayReport& report, const ReplayOptions& options) {
  if (options.json) {
    print_json({{"equal", report.equal},
                {"inputs", report.inputs},
                {"outputs", report.outputs},
                {"computes", report.computes},
                {"recomputed", report.recomputed},
                {"unfinished", report.unfinished},
                {"difference", report.difference},
                {"note", report.note}});
    return;
  }
  fmt::print("{}: {} inputs; {} messages and {} computations compared, {} computations repeated: {}\n", options.node,
             report.inputs, report.outputs, report.computes, report.recomputed,
             report.equal ? "the same, byte for byte" : "DIFFERENT");
  if (!report.difference.empty()) fmt::print("first difference: {}\n", report.difference);
  if (!report.note.empty()) fmt::print("note: {}\n", report.note);
}

/// The scenario to replay with. What differs under another one than the run's is no fault of the program: warns then.
game::Scenario read_scenario(const fs::path& folder, const ReplayOptions& options) {
  const fs::path file = options.scenario.empty() ? folder / "scenario.toml" : fs::path(options.scenario);
  game::Scenario scenario = game::read_scenario(file);
  if (!fs::exists(folder / "manifest.json")) return scenario;
  if (content_hash(read_file(file)) != runtime::read_manifest(folder).scenario_hash)
    warn(fmt::format("{}: not the scenario that the run was played with; what differs may come from that",
                     file.string()));
  return scenario;
}

int replay(const ReplayOptions& options) {
  const fs::path path = options.run;
  const bool is_bus_log = fs::is_regular_file(path);
  if (is_bus_log && path.filename() == "journal.lcm")
    throw InputError::format("{}: is a node's journal, expected the run's folder or its run.lcm", path.string());
  const fs::path folder = is_bus_log ? path.parent_path() : path;
  const game::Scenario scenario = read_scenario(folder, options);
  const TemporaryFolder scratch("replay");  // a replay never touches the run
  // A person may have left the grouping of the family stage there.
  const fs::path families = fs::path("families") / "families.toml";
  if (fs::exists(folder / families)) {
    fs::create_directories((scratch.path() / families).parent_path());
    fs::copy_file(folder / families, scratch.path() / families);
  }
  runtime::NodeProgram program = make_node(options.node, scenario, scratch.path());
  const runtime::ReplayReport report = is_bus_log
                                           ? runtime::replay_bus_log(path, options.node, *program.core, program.work)
                                           : runtime::replay_journal(folder / "nodes" / options.node / "journal.lcm",
                                                                     *program.core, program.work, options.recompute);
  print_report(report, options);
  return report.equal ? 0 : 1;
}

}  // namespace

void add_replay(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App& command = add_command(app, action, "replay",
                                  "Feed a recorded game to one node again, and compare what it sends", options, replay);
  command
      .add_option("RUN", options->run, "Folder of a run (exact, from the node's journal) or its run.lcm (best effort)")
      ->capture_default_str();
  command.add_option("--node", options->node, "Node to replay")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(game::kNodes.begin(), game::kNodes.end())));
  command.add_option("--scenario", options->scenario,
                     "Scenario of the run; default: scenario.toml in the folder of the run");
  command.add_flag("--recompute", options->recompute, "Repeat the long computations and compare their results too");
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
