#include "runtime/node_main.hpp"

#include <exception>
#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>

#include "base/files.hpp"
#include "base/no_space.hpp"
#include "base/result.hpp"
#include "game/scenario.hpp"
#include "runtime/debugger.hpp"
#include "runtime/run_folder.hpp"
#include "runtime/version.hpp"

namespace nacre::runtime {
namespace {

/// A folder that a mistyped name would make, and a run that nobody else plays, would be waited in for ever.
void expect_run(NodeOptions& options) {
  const std::string run_id = read_manifest(options.run_dir).run_id;
  if (options.run_id.empty()) options.run_id = run_id;
  if (options.run_id == run_id) return;
  throw InputError::format("--run-id {}: expected {}, which {} names", options.run_id, run_id,
                           (options.run_dir / "manifest.json").string());
}

}  // namespace

void add_node_options(CLI::App& app, NodeOptions& options) {
  app.add_option("--run-dir", options.run_dir, "folder of the run, logs/RUN")->required();
  app.add_option("--scenario", options.scenario_file, "scenario (default: scenario.toml of the run)");
  app.add_option("--run-id", options.run_id, "name of the run, as its manifest says");
  app.add_option("--port", options.port, "UDP port of the run's bus")->required()->check(CLI::Range(1, 65535));
  app.add_option("--threads", options.threads, "threads for long work")->check(CLI::Range(0, 4096));
  app.add_option("--epoch", options.epoch, "start of this process in microseconds since 1970 (default: now)");
  app.add_option("--url", options.url, "LCM address instead of the port's");
  app.add_flag("--wait-for-debugger", options.wait_for_debugger, "wait until a debugger has attached");
  app.add_flag("!--detached", options.follow_parent, "go on when the process that started the node ends");
}

int node_main(int argc, char** argv, const std::string& node, const MakeNode& make,
              const std::function<void(CLI::App&)>& add_options) {
  turn_write_signals_into_errors();  // before any file is opened
  CLI::App app("nacre " + node);
  app.set_version_flag("--version", version_in_words);
  NodeOptions options;
  options.node = node;
  add_node_options(app, options);
  if (add_options) add_options(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    const int status = app.exit(problem);
    return status == 0 ? 0 : 2;
  }
  try {
    if (options.wait_for_debugger) wait_for_debugger();
    options.run_dir = without_last_slash(std::filesystem::absolute(options.run_dir).lexically_normal());
    expect_run(options);
    if (options.scenario_file.empty()) options.scenario_file = options.run_dir / "scenario.toml";
    const game::Scenario scenario = game::read_scenario(options.scenario_file);
    options.participants = scenario.nodes();
    options.lan = scenario.hosts == "lan";
    NodeProgram program = make(options, scenario);
    if (options.threads == 0) options.threads = program.default_threads;
    return run_node(std::move(options), std::move(program.core), std::move(program.work), program.executor);
  } catch (const NoSpace& problem) {  // a death like any other: there may be room at the next start
    std::cerr << node << ": " << problem.what() << '\n';
    return 1;
  } catch (const InputError& problem) {
    std::cerr << node << ": " << problem.what() << '\n';
    return 2;
  } catch (const std::exception& problem) {
    std::cerr << node << ": " << problem.what() << '\n';
    return 1;
  }
}

}  // namespace nacre::runtime
